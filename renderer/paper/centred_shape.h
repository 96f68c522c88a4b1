// SPDX-License-Identifier: MIT
// A shape relative to its own centre. The centre's position in the world is stored separately, so
// that queries on two shapes are as precise a kilometre from the world's origin as at the origin.
#pragma once

#include "core/derived/shape_bounds.h"
#include "core/math/affine.h"
#include "core/math/bounds.h"
#include "core/shape/shape.h"

namespace minkray {

/// The points of the shape are centre + x for all x of `about_centre`.
struct CentredShape {
  Shape about_centre;
  Vec3<double> centre;
  double radius;  ///< radius of a ball around the centre that contains the shape
};

/// Converts a shape at a pose. `pose` maps the shape's frame to the world and must be invertible.
/// Affine maps around the shape are composed with the pose; the translation of the result becomes
/// part of `centre`.
inline CentredShape centred(Shape shape, const Affine<double>& pose = {}) {
  Affine<double> to_world = pose;
  while (const auto* transform = std::get_if<Transform>(&shape.kind)) {
    to_world = to_world * transform->map.affine();
    Shape inner = *transform->shape;
    shape = std::move(inner);
  }
  const Vec3<double> middle = bounds_of(shape).centre();
  const Vec3<double> centre = to_world(middle);
  const bool in_place = middle == Vec3<double>::Zero();
  if (!in_place || to_world.linear != Mat3<double>::Identity())
    shape = Transform{shape, Affine<double>{to_world.linear, -(to_world.linear * middle)}};
  const double radius = bounds_of(shape).half_extents().stableNorm();
  // The centre is the box's middle only up to rounding; the larger radius allows for this.
  return {std::move(shape), centre, radius * (1.0 + 16.0 * std::numeric_limits<double>::epsilon())};
}

}  // namespace minkray
