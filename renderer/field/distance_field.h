// SPDX-License-Identifier: MIT
// Signed distance of a probe from a scene, over the points of a plane: the least signed distance
// from any object (core/pair_distance/signed_distance.h).
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "core/shape/shape.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// The middle of pixel (x, y) is corner + (x + 1/2) right + (y + 1/2) down.
struct FieldPlane {
  int width = 0, height = 0;
  Vec3<double> corner, right, down;

  Vec3<double> at(int x, int y) const { return corner + (x + 0.5) * right + (y + 0.5) * down; }
};

/// The plane through `middle` as seen from the tip of its normal; z is up, or y where one looks
/// along z. A picture of `width` pixels is as wide as `extent`.
FieldPlane plane_facing(const Vec3<double>& middle, const Vec3<double>& normal, double extent,
                        int width, int height);

/// One number per pixel, rows from the top. The truth is between lower and upper.
///
/// An object may be so large or far that its distance is unknown (SignedDistance::is_unknown()):
/// `lower` is the bound from the balls around it and the probe, which may be -infinity; `value` is
/// the least distance of the others, infinite if there are none.
struct DistanceField {
  FieldPlane plane;
  std::vector<double> value, lower, upper;
  std::vector<int> object;  ///< the index of the nearest; -1 if the scene has none or is_unknown()
  std::size_t supports = 0;

  /// True if an object of unknown distance may be nearer than `value`.
  bool is_unknown(std::size_t pixel) const {
    return object[pixel] < 0 && lower[pixel] < std::numeric_limits<double>::infinity();
  }
};

struct FieldOptions {
  double tolerance = 1e-6;  ///< of the bounds, relative to the sizes of probe and object
  /// Called once per row; returns true to continue.
  std::function<bool()> go_on;
};

/// The probe's origin goes over the plane. Throws BadInput for a scene with particles.
DistanceField measure_field(const Scene& scene, const Shape& probe, const FieldPlane& plane,
                            const FieldOptions& options);

}  // namespace minkray
