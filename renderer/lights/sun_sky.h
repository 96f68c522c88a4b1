// SPDX-License-Identifier: MIT
// Clear sky with a sun: Preetham, Shirley and Smits, "A Practical Analytic Model for Daylight"
// (1999), with its published coefficients. Radiance 1 is 10 kcd/m^2.
#pragma once

#include <memory>

#include "renderer/image/image.h"
#include "renderer/lights/lights.h"

namespace minkray {

/// The sun's disk, evenly bright.
class SunDisk final : public SkySource {
 public:
  explicit SunDisk(const SunSkyLight& light);

  Colour eval(const Vec3<double>& direction) const override;
  std::optional<LightSample> sample(const Vec3<double>& point, Sampler& sampler) const override;
  double pdf(const Vec3<double>& point, const Vec3<double>& direction) const override;
  bool is_asked() const override { return true; }

 private:
  bool is_in_disk(const Vec3<double>& direction) const;

  Vec3<double> towards_;
  Colour radiance_;
};

/// The sky without the sun as a picture of the whole sphere (renderer/lights/sky_image.h); below
/// the horizon the ground.
std::shared_ptr<const Image> sky_of(const SunSkyLight& light);

}  // namespace minkray
