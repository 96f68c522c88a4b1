// SPDX-License-Identifier: MIT
// A shape relative to its own middle: the middle's place in the world is stored separately, so that
// queries on two shapes are as precise a kilometre from the world's origin as at the origin.
#pragma once

#include "core/derived/shape_bounds.h"
#include "core/math/affine.h"
#include "core/math/bounds.h"
#include "core/shape/shape.h"

namespace minkray {

/// The points of the shape are centre + x for all x of `about_centre`.
template <class T>
struct CentredShape {
  Shape<T> about_centre;
  Vec3<T> centre;
  T radius;  ///< radius of a ball around the centre that contains the shape
};

/// `pose` maps the shape's frame to the world; it must be invertible. Affine maps around the shape
/// are joined, and their translation goes into the centre.
template <class T>
CentredShape<T> centred(Shape<T> shape, const Affine<T>& pose = {}) {
  Affine<T> to_world = pose;
  while (const auto* transform = std::get_if<Transform<T>>(&shape.kind)) {
    to_world = to_world * transform->map.affine();
    Shape<T> inner = *transform->shape;
    shape = std::move(inner);
  }
  const Vec3<T> middle = bounds_of<T>(shape).centre();
  const Vec3<T> centre = to_world(middle);
  const bool in_place = middle == Vec3<T>::Zero();
  if (!in_place || to_world.linear != Mat3<T>::Identity())
    shape = Transform<T>{shape, Affine<T>{to_world.linear, -(to_world.linear * middle)}};
  const T radius = bounds_of<T>(shape).half_extents().stableNorm();
  // The box's middle is the centre up to rounding, which the radius allows for.
  return {std::move(shape), centre, radius * (T(1) + T(16) * std::numeric_limits<T>::epsilon())};
}

}  // namespace minkray
