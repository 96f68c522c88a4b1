// SPDX-License-Identifier: MIT
#include "renderer/lights/sun_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/rays/frame.h"

namespace minkray {
namespace {

using std::numbers::pi;

/// Half the angle under which the sun is seen, in radians.
constexpr double sun_radius = 0.2665 * pi / 180;

/// 1 - cosine of it.
const double sun_height = 2 * std::sin(sun_radius / 2) * std::sin(sun_radius / 2);

/// The sun above the atmosphere: 128 klx over its solid angle, in kcd/m^2.
constexpr double sun_luminance = 1.88e6;

/// Luminance of radiance 1, in kcd/m^2.
constexpr double unit_luminance = 10;

/// The distribution of Perez et al. by the cosine to the zenith and the angle to the sun.
struct Perez {
  double a, b, c, d, e;

  double operator()(double cosine, double to_sun) const {
    const double s = std::cos(to_sun);
    return (1 + a * std::exp(b / cosine)) * (1 + c * std::exp(d * to_sun) + e * s * s);
  }
};

/// A polynomial of third degree of the sun's angle to the zenith, of second degree of turbidity.
using Table = std::array<std::array<double, 4>, 3>;
double at_zenith(const Table& table, double turbidity, double angle) {
  const double powers[4] = {angle * angle * angle, angle * angle, angle, 1};
  const double of_turbidity[3] = {turbidity * turbidity, turbidity, 1};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) sum += of_turbidity[i] * table[i][k] * powers[k];
  return sum;
}

constexpr Table x_at_zenith = {{{0.00166, -0.00375, 0.00209, 0},
                                {-0.02903, 0.06377, -0.03202, 0.00394},
                                {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr Table y_at_zenith = {{{0.00275, -0.00610, 0.00317, 0},
                                {-0.04214, 0.08970, -0.04153, 0.00516},
                                {0.15346, -0.26756, 0.06670, 0.26688}}};

/// Linear sRGB of chromaticities and luminance; what sRGB has no colour for is cut off.
Colour rgb_of(double x, double y, double luminance) {
  const double X = x / y * luminance, Z = (1 - x - y) / y * luminance;
  return Colour(3.2406 * X - 1.5372 * luminance - 0.4986 * Z,
                -0.9689 * X + 1.8758 * luminance + 0.0415 * Z,
                0.0557 * X - 0.2040 * luminance + 1.0570 * Z)
      .cwiseMax(0.0);
}

class Sky {
 public:
  explicit Sky(const SunSkyLight& light) : sun_(unit(light.sun)) {
    const double T = light.turbidity, angle = std::acos(std::clamp(sun_.z(), 0.0, 1.0));
    luminance_ = {0.1787 * T - 1.4630, -0.3554 * T + 0.4275, -0.0227 * T + 5.3251,
                  0.1206 * T - 2.5771, -0.0670 * T + 0.3703};
    x_ = {-0.0193 * T - 0.2592, -0.0665 * T + 0.0008, -0.0004 * T + 0.2125, -0.0641 * T - 0.8989,
          -0.0033 * T + 0.0452};
    y_ = {-0.0167 * T - 0.2608, -0.0950 * T + 0.0092, -0.0079 * T + 0.2102, -0.0441 * T - 1.6537,
          -0.0109 * T + 0.0529};
    const double chi = (4.0 / 9 - T / 120) * (pi - 2 * angle);
    const double zenith = (4.0453 * T - 4.9710) * std::tan(chi) - 0.2155 * T + 2.4192;
    scale_luminance_ = std::max(zenith, 0.0) / luminance_(1, angle);
    scale_x_ = at_zenith(x_at_zenith, T, angle) / x_(1, angle);
    scale_y_ = at_zenith(y_at_zenith, T, angle) / y_(1, angle);
  }

  Colour operator()(const Vec3<double>& direction) const {
    // At the horizon itself the distribution has no value.
    const double cosine = std::max(direction.z(), 0.01);
    const double to_sun = std::acos(std::clamp(direction.dot(sun_), -1.0, 1.0));
    return rgb_of(scale_x_ * x_(cosine, to_sun), scale_y_ * y_(cosine, to_sun),
                  scale_luminance_ * luminance_(cosine, to_sun)) /
           unit_luminance;
  }

 private:
  Vec3<double> sun_;
  Perez luminance_{}, x_{}, y_{};
  double scale_luminance_ = 0, scale_x_ = 0, scale_y_ = 0;
};

/// Share of red, green and blue light that gets through the air to the ground: scattered by
/// molecules and by haze (the paper's appendix, without its weaker absorbers).
Colour through_air(double cosine, double turbidity) {
  const double degrees = std::acos(std::clamp(cosine, 0.0, 1.0)) * 180 / pi;
  const double mass = 1 / (std::max(cosine, 0.0) + 0.15 * std::pow(93.885 - degrees, -1.253));
  const double haze = 0.04608 * turbidity - 0.04586;
  const std::array<double, 3> micrometres = {0.65, 0.55, 0.45};
  Colour left;
  for (std::size_t i = 0; i < 3; ++i)
    left[static_cast<int>(i)] =
        std::exp(-0.008735 * std::pow(micrometres[i], -4.08) * mass) *
        std::exp(-std::max(haze, 0.0) * std::pow(micrometres[i], -1.3) * mass);
  return left;
}

}  // namespace

SunDisk::SunDisk(const SunSkyLight& light)
    : towards_(unit(light.sun)),
      radiance_(light.strength * sun_luminance / unit_luminance *
                through_air(towards_.z(), light.turbidity)) {}

bool SunDisk::is_in_disk(const Vec3<double>& direction) const {
  return (direction - towards_).squaredNorm() <= 2 * sun_height;
}

Colour SunDisk::eval(const Vec3<double>& direction) const {
  return is_in_disk(direction) ? radiance_ : Colour(Colour::Zero());
}

std::optional<LightSample> SunDisk::sample(const Vec3<double>&, Sampler& sampler) const {
  const std::array<double, 2> u = sampler.next();
  const double below = u[0] * sun_height, angle = 2 * pi * u[1];
  const double sine = std::sqrt(below * (2 - below));
  const Vec3<double> direction =
      Frame(towards_).to_world({sine * std::cos(angle), sine * std::sin(angle), 1 - below});
  return LightSample{direction, std::numeric_limits<double>::infinity(),
                     radiance_ * (2 * pi * sun_height)};
}

double SunDisk::pdf(const Vec3<double>&, const Vec3<double>& direction) const {
  return is_in_disk(direction) ? 1 / (2 * pi * sun_height) : 0;
}

std::shared_ptr<const Image> sky_of(const SunSkyLight& light) {
  const Sky sky(light);
  const auto image = std::make_shared<Image>(512, 256);
  for (int row = 0; row < image->height; ++row)
    for (int column = 0; column < image->width; ++column) {
      const double latitude = pi * (row + 0.5) / image->height;
      const double longitude = 2 * pi * ((column + 0.5) / image->width - 0.5);
      const Vec3<double> direction(std::sin(latitude) * std::sin(longitude),
                                   std::sin(latitude) * std::cos(longitude), std::cos(latitude));
      const Colour colour = direction.z() > 0 ? sky(direction) : light.ground;
      image->at(column, row) = colour.cast<float>();
    }
  return image;
}

}  // namespace minkray
