// SPDX-License-Identifier: MIT
// Light sources. For every light sample draws a direction that light comes from, and pdf is the
// density of the draws over solid angle. A light with a single direction has no density.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "renderer/rays/sampler.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Light that comes to a point if nothing is in its way.
struct LightSample {
  Vec3<double> direction;  ///< towards the light, of unit length
  double distance;         ///< infinite for lights that are infinitely far
  Colour weight;           ///< the irradiance on a surface that faces it: radiance / pdf
};

/// Light from all around, of any kind.
class SkySource {
 public:
  virtual ~SkySource() = default;

  /// The radiance from a direction of unit length.
  virtual Colour eval(const Vec3<double>& direction) const = 0;
  virtual std::optional<LightSample> sample(const Vec3<double>& point, Sampler& sampler) const = 0;
  virtual double pdf(const Vec3<double>& point, const Vec3<double>& direction) const = 0;
  /// True if the light is worth its own rays. Not if it is about equally bright everywhere, since
  /// BSDF samples find it as well.
  virtual bool is_asked() const = 0;
};

class DirectionalSource {
 public:
  explicit DirectionalSource(const DirectionalLight& light);

  std::optional<LightSample> sample(const Vec3<double>& point, Sampler& sampler) const;
  double pdf(const Vec3<double>& point, const Vec3<double>& direction) const;

 private:
  Vec3<double> towards_;
  Colour irradiance_;
};

class PointSource {
 public:
  explicit PointSource(const PointLight& light);

  /// Nothing at the light's own position.
  std::optional<LightSample> sample(const Vec3<double>& point, Sampler& sampler) const;
  double pdf(const Vec3<double>& point, const Vec3<double>& direction) const;

 private:
  Vec3<double> position_;
  Colour intensity_;
};

/// A vertical gradient all around.
class EnvironmentSource final : public SkySource {
 public:
  EnvironmentSource(const Colour& zenith, const Colour& nadir);

  /// The radiance from a direction of unit length.
  Colour eval(const Vec3<double>& direction) const override;

  /// Drawn as bright as the gradient is there, the mean of its colours; nothing if it is black.
  std::optional<LightSample> sample(const Vec3<double>& point, Sampler& sampler) const override;
  double pdf(const Vec3<double>& point, const Vec3<double>& direction) const override;
  bool is_asked() const override { return false; }

 private:
  Colour zenith_, nadir_;
  double nadir_part_;  ///< of the brightness straight up and down together
};

/// The lights of a scene.
class Lights {
 public:
  explicit Lights(const std::vector<Light>& lights);

  /// Number of lights that shine from a single direction at each point: each gets a shadow ray of
  /// its own, directional ones first.
  std::size_t count() const { return narrow_.size(); }
  std::optional<LightSample> sample(std::size_t light, const Vec3<double>& point,
                                    Sampler& sampler) const;

  /// Light from all around is found by rays that leave the scene; part of it is also sampled
  /// directly.
  const std::vector<std::unique_ptr<const SkySource>>& skies() const { return environments_; }
  bool has_environment() const { return !environments_.empty(); }
  Colour environment(const Vec3<double>& direction) const;

 private:
  std::vector<std::variant<DirectionalSource, PointSource>> narrow_;
  std::vector<std::unique_ptr<const SkySource>> environments_;
};

}  // namespace minkray
