// SPDX-License-Identifier: MIT
// Environment light from a picture of the whole sphere: width by longitude, height by latitude.
// Directions are sampled by the brightness of the picture's cells (Pharr, Jakob and Humphreys,
// "Physically Based Rendering", section on image infinite lights).
#pragma once

#include <memory>

#include "renderer/image/image.h"
#include "renderer/lights/alias_table.h"
#include "renderer/lights/lights.h"

namespace minkray {

class SkyImage final : public SkySource {
 public:
  /// The picture's middle is at the horizon, towards +y, with +x on its right; `turn` in radians
  /// turns it against the clock as seen from above.
  SkyImage(std::shared_ptr<const Image> image, double strength, double turn);

  /// The radiance from a direction of unit length.
  Colour eval(const Vec3<double>& direction) const override;

  std::optional<LightSample> sample(const Vec3<double>& point, Sampler& sampler) const override;
  double pdf(const Vec3<double>& point, const Vec3<double>& direction) const override;
  bool is_asked() const override { return true; }

 private:
  Colour texel(int x, int y) const;
  std::size_t cell_of(const Vec3<double>& direction) const;
  /// Position of a direction in the picture: 0 to 1 from its left and from its top.
  std::array<double, 2> place(const Vec3<double>& direction) const;

  std::shared_ptr<const Image> image_;
  double strength_, turn_;
  int columns_, rows_;  ///< of cells
  AliasTable cells_;
};

}  // namespace minkray
