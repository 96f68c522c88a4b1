// SPDX-License-Identifier: MIT
// "First solution" for casting a ray: Algorithm 1 of van den Bergen (2004), section 2. Clips the
// ray repeatedly by the supporting plane at c, the object's point closest to x, which a nested GJK
// distance query finds. Slow; a reference for the other solvers. As in the paper, n = x - c is a
// normal at c. Points are relative to the bounding ball's centre; lambda is a length from the point
// of the ray closest to that centre.
#pragma once

#include "core/math/bounds.h"
#include "core/query/miss_plane.h"
#include "core/query/observer.h"
#include "core/query/ray_near_ball.h"
#include "core/query/result.h"
#include "core/support/support_mapped.h"
#include "renderer/paper/gjk_distance.h"

namespace minkray {

/// Returns the least parameter at which the ray is in the shape, as gjk_ray_cast does. `iterations`
/// counts iterations of Algorithm 1; `supports` and `max_supports` count the support points of all
/// nested queries.
template <class T, class S, class Observer = NoObserver>
requires SupportMapped<S, T> CastResult<T> first_solution(
    const S& shape, const RayNearBall<T>& near, const Ball<T>& ball,
    int max_supports = tolerance::first_solution_max_supports, Observer&& observer = {}) {
  CastResult<T> result;
  const Vec3<T>&s = near.s, &r = near.r;
  result.t_base = near.t_base;
  const auto miss = [&](const Vec3<T>& axis) {
    result.status = Status::miss;
    result.normal = unit(axis);
    return result;
  };

  // The bounding ball, as in gjk_ray_cast.
  const T nearest = std::clamp(T(0), near.lambda_min, near.lambda_max);
  const Vec3<T> to_ray = s + nearest * r;
  if (to_ray.norm() > ball.radius * (T(1) + tolerance::ball_padding<T>)+near.loss)
    return miss(to_ray);
  const T depth = std::sqrt(std::max(ball.radius * ball.radius - s.squaredNorm(), T(0)));
  const bool from_origin = near.lambda_min >= -depth;
  T lambda = std::max(near.lambda_min, -depth);
  Vec3<T> n = Vec3<T>::Zero();
  bool has_advanced = false;

  const auto supports = [&](const Vec3<T>& v) {
    return SupportPair<T, 3>{shape.support(v) - ball.centre, Vec3<T>::Zero()};
  };
  const auto finish = [&] {
    result.t_offset = result.offset_lo = near.t_offset(lambda);
    if (from_origin && !has_advanced) {
      result.status = Status::inside;
      result.offset_hi = result.t_offset;
      return result;
    }
    result.status = Status::hit;
    result.normal = unit(has_advanced ? n : Vec3<T>(s + lambda * r));
    return result;
  };

  while (result.supports < max_supports) {
    ++result.iterations;
    const Vec3<T> x = s + lambda * r;
    DistanceOptions<T, 3> nested;
    nested.v0 = n;
    const DistanceResult<T, 3> closest = gjk_distance<T, 3>(supports, x, ball.radius, nested);
    result.supports += closest.supports;
    const Vec3<T>& c = closest.point_a;
    // True if x is close enough to c, or inside the object at the beginning.
    const bool is_close = closest.status == DistanceStatus::overlapping ||
                          closest.distance <= tolerance::gjk_rounding<T> * ball.radius;
    // Clips by the nested query's best plane instead of the plane through c: the query's plane
    // never cuts into the object.
    const Vec3<T> axis = closest.axis;
    observer(CastIteration<T>{lambda, x, axis, c, x - c, {}});
    if (is_close) return finish();
    if (!(closest.lower > T(0))) {
      if (closest.distance <= tolerance::gjk_stalled<T> * ball.radius) return finish();
      break;
    }
    const T axis_r = axis.dot(r);
    const T clipped = lambda - closest.lower / axis_r;
    if (!(axis_r < T(0))) {
      // The ray before x is separated by the plane that clipped last or, if none did, by the ball's
      // tangent plane at the start of the cast.
      if (from_origin && !has_advanced) return miss(axis);
      return miss(joined_plane(axis, has_advanced ? n : x, r));
    }
    if (clipped > near.lambda_max) return miss(axis);
    // The advance is too small to change lambda: x is as close as rounding allows.
    if (!(clipped > lambda)) return finish();
    lambda = clipped;
    n = axis;
    has_advanced = true;
  }
  result.t_offset = result.offset_lo = near.t_offset(lambda);
  result.normal = unit(n);
  return result;
}

}  // namespace minkray
