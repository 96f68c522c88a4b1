// SPDX-License-Identifier: MIT
// The part of a ray that can meet a shape, relative to the centre of the shape's bounding box.
// Proofs that use this part are as precise for far origins and infinite rays as for near origins
// and short rays.
#pragma once

#include <cmath>

#include "core/derived/shape_bounds.h"
#include "core/math/ray.h"

namespace minkray {

/// The points centre + s + lambda * r with begin <= lambda <= end, where r is the ray's unit
/// direction, and lambda is a length. These are the ray's points between the two supporting planes
/// of the shape that are perpendicular to the ray; no other point of the ray is in the shape. The
/// segment is empty if begin > end.
struct NearSegment {
  /// Centre of the shape's bounding box; the point of the ray's line closest to the centre,
  /// relative to the centre; unit direction of the ray.
  Vec3<double> centre, s, r;
  double begin = 0, end = 0;
  double first = 0;  ///< lambda at the first of the two planes, even if the ray begins later
  double t_base = 0, t_shift = 0;  ///< their sum is the ray parameter t at lambda = 0
  bool is_too_far = false;         ///< the origin is too far away: the segment is inaccurate
  double speed = 0;                ///< length of the ray's direction
  /// Upper bound of the magnitude of the shape's points in the ray's frame: distance of `centre`
  /// from the frame's origin + radius of the bounding box.
  double size = 0;

  /// Point at lambda, relative to `centre`.
  Vec3<double> at(double lambda) const { return s + lambda * r; }
  /// lambda at t = base + offset.
  double lambda_of(double base, double offset) const {
    return ((base - t_base) + (offset - t_shift)) * speed;
  }
  /// t at lambda, minus t_base.
  double t_offset(double lambda) const { return speed > 0 ? t_shift + lambda / speed : 0; }
};

/// Computes the segment with eight support points. `support` takes a direction, Vec3<double>.
template <class Support>
NearSegment near_segment(const Support& support, const Ray<double>& ray) {
  struct Named {
    const Support& function;
    // SupportMapped requires a function of this name.
    Vec3<double> support(const Vec3<double>& n) const { return function(n); }
  };
  const Bounds<double> bounds = bounds_of(Named{support});
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
  // Moves s along the ray, from its origin to the point closest to the centre, in two steps in long
  // double. fma rounds only once, relative to its result. The second step removes the error due to
  // the rounded parameter of the first step.
  using Long = long double;
  const Vec3<Long> centre = near.centre.cast<Long>();
  Vec3<Long> s = ray.origin.cast<Long>();
  const auto move = [&](double t) {
    for (int axis = 0; axis < 3; ++axis) s[axis] = std::fma(Long(t), Long(d[axis]), s[axis]);
  };
  const auto parameter = [&] {
    return -static_cast<double>((s - centre).dot(near.r.cast<Long>()) / near.speed);
  };
  near.t_base = parameter();
  move(near.t_base);
  const auto step = static_cast<double>((s - centre).norm());
  near.t_shift = parameter();
  move(near.t_shift);
  near.s = (s - centre).cast<double>();
  // The second step moves s by the distance that remains after the first step. If that distance is
  // more than `most` times the size of the coordinates near the shape, long double rounds the step
  // as coarsely as double rounds those coordinates.
  const double most = std::numeric_limits<double>::epsilon() / std::numeric_limits<Long>::epsilon();
  near.is_too_far = !(step <= most * (near.size + near.s.norm()));
  const double pad = 8 * std::numeric_limits<double>::epsilon() * near.size;
  const double at_s = near.r.dot(near.s);
  near.first = near.r.dot(support(-near.r) - near.centre) - at_s - pad;
  const double last = near.r.dot(support(near.r) - near.centre) - at_s + pad;
  near.begin = std::max(near.first, near.lambda_of(0, 0));
  near.end = std::min(last, near.lambda_of(ray.t_max, 0));
  return near;
}

}  // namespace minkray
