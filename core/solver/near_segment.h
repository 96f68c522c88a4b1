// SPDX-License-Identifier: MIT
// The part of a ray that a shape can have anything to do with, seen from the shape's middle: so
// that proofs about it are as precise for far origins and endless rays as for near ones.
#pragma once

#include <cmath>

#include "core/math/ray.h"
#include "core/shape/shape_bounds.h"

namespace minkray {

/// The points centre + s + lambda * r with begin <= lambda <= end, a length: those between the
/// shape's two supporting planes at right angles to the ray. All other points of the ray lie
/// outside one of the two. Empty if begin > end.
struct NearSegment {
  Vec3<double> centre, s, r;
  double begin = 0, end = 0;
  double first = 0;   ///< where the supporting plane is that the ray meets from outside
  double t_base = 0;  ///< the ray's parameter at lambda = 0
  double speed = 0;   ///< length of the ray's direction
  double size = 0;    ///< of the largest coordinates that occur: the middle's distance + radius

  Vec3<double> at(double lambda) const { return s + lambda * r; }
  double lambda_of(double base, double offset) const { return ((base - t_base) + offset) * speed; }
  double t_offset(double lambda) const { return speed > 0 ? lambda / speed : 0; }
};

/// Asks for eight support points. `support` is called with directions, Vec3<double>.
template <class Support>
NearSegment near_segment(const Support& support, const Ray<double>& ray) {
  struct Named {
    const Support& function;
    // SupportMapped's name.
    Vec3<double> support(const Vec3<double>& n) const { return function(n); }
  };
  const Bounds<double> bounds = bounds_of<double>(Named{support});
  NearSegment near;
  near.centre = bounds.centre();
  near.size = near.centre.norm() + bounds.half_extents().norm();
  const Vec3<double>& d = ray.direction;
  near.speed = d.stableNorm();
  near.r = unit(d);
  if (!(near.speed > 0)) {
    near.s = ray.origin - near.centre;
    return near;
  }
  // fma rounds once, to the size of the result.
  near.t_base = -((ray.origin - near.centre).dot(near.r) / near.speed);
  for (int axis = 0; axis < 3; ++axis)
    near.s[axis] = std::fma(near.t_base, d[axis], ray.origin[axis]) - near.centre[axis];
  const double pad = 8 * std::numeric_limits<double>::epsilon() * near.size;
  const double at_s = near.r.dot(near.s);
  near.first = near.r.dot(support(-near.r) - near.centre) - at_s - pad;
  const double last = near.r.dot(support(near.r) - near.centre) - at_s + pad;
  near.begin = std::max(near.first, near.lambda_of(0, 0));
  near.end = std::min(last, near.lambda_of(ray.t_max, 0));
  return near;
}

}  // namespace minkray
