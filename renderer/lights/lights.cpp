// SPDX-License-Identifier: MIT
#include "renderer/lights/lights.h"

#include <limits>
#include <numbers>

#include "renderer/lights/sky_image.h"
#include "renderer/lights/sun_sky.h"

namespace minkray {

DirectionalSource::DirectionalSource(const DirectionalLight& light)
    : towards_(-unit(light.direction)), irradiance_(light.colour) {}

std::optional<LightSample> DirectionalSource::sample(const Vec3<double>&, Sampler&) const {
  return LightSample{towards_, std::numeric_limits<double>::infinity(), irradiance_};
}

double DirectionalSource::pdf(const Vec3<double>&, const Vec3<double>&) const {
  return 0;
}

PointSource::PointSource(const PointLight& light)
    : position_(light.position), intensity_(light.colour) {}

std::optional<LightSample> PointSource::sample(const Vec3<double>& point, Sampler&) const {
  const Vec3<double> to_light = position_ - point;
  const double distance = to_light.norm();
  if (!(distance > 0)) return std::nullopt;
  return LightSample{to_light / distance, distance, intensity_ / (distance * distance)};
}

double PointSource::pdf(const Vec3<double>&, const Vec3<double>&) const {
  return 0;
}

EnvironmentSource::EnvironmentSource(const Colour& zenith, const Colour& nadir)
    : zenith_(zenith), nadir_(nadir), nadir_part_(nadir.sum() / (zenith + nadir).sum()) {}

Colour EnvironmentSource::eval(const Vec3<double>& direction) const {
  const double up = 0.5 + 0.5 * direction.z();
  return up * zenith_ + (1 - up) * nadir_;
}

// Heights are even over the sphere, so that the brightness is a linear density of `up`, from n at 0
// to 1 - n at 1 (times 2). Its integral 2 n up + (1 - 2 n) up^2 is solved for u, in the form that
// does not cancel.
std::optional<LightSample> EnvironmentSource::sample(const Vec3<double>& point,
                                                     Sampler& sampler) const {
  const double n = nadir_part_;
  const std::array<double, 2> u = sampler.next();
  const double root = std::sqrt(std::max(n * n + (1 - 2 * n) * u[0], 0.0));
  if (!(n + root > 0)) return std::nullopt;
  const double up = std::min(u[0] / (n + root), 1.0);
  const double z = 2 * up - 1, radius = 2 * std::sqrt(up * (1 - up));
  const double angle = 2 * std::numbers::pi * u[1];
  const Vec3<double> direction(radius * std::cos(angle), radius * std::sin(angle), z);
  return LightSample{direction, std::numeric_limits<double>::infinity(),
                     eval(direction) / pdf(point, direction)};
}

double EnvironmentSource::pdf(const Vec3<double>&, const Vec3<double>& direction) const {
  const double up = 0.5 + 0.5 * direction.z(), n = nadir_part_;
  return n >= 0 ? (up * (1 - n) + (1 - up) * n) / (2 * std::numbers::pi) : 0;
}

Lights::Lights(const std::vector<Light>& lights) {
  for (const Light& light : lights)
    if (const auto* sun = std::get_if<DirectionalLight>(&light))
      narrow_.emplace_back(DirectionalSource(*sun));
  for (const Light& light : lights)
    if (const auto* lamp = std::get_if<PointLight>(&light))
      narrow_.emplace_back(PointSource(*lamp));
  for (const Light& light : lights)
    if (const auto* sky = std::get_if<EnvironmentLight>(&light))
      environments_.push_back(std::make_unique<EnvironmentSource>(sky->zenith, sky->nadir));
  for (const Light& light : lights) {
    if (const auto* sky = std::get_if<ImageSkyLight>(&light))
      environments_.push_back(std::make_unique<SkyImage>(
          sky->picture.image, sky->strength, sky->rotate_degrees * std::numbers::pi / 180));
    if (const auto* day = std::get_if<SunSkyLight>(&light)) {
      environments_.push_back(std::make_unique<SkyImage>(sky_of(*day), day->strength, 0.0));
      environments_.push_back(std::make_unique<SunDisk>(*day));
    }
  }
}

std::optional<LightSample> Lights::sample(std::size_t light, const Vec3<double>& point,
                                          Sampler& sampler) const {
  return std::visit([&](const auto& source) { return source.sample(point, sampler); },
                    narrow_[light]);
}

Colour Lights::environment(const Vec3<double>& direction) const {
  Colour sum = Colour::Zero();
  for (const auto& source : environments_) sum += source->eval(direction);
  return sum;
}

}  // namespace minkray
