// SPDX-License-Identifier: MIT
// Casts at a shape's bounds, before the cast at the shape itself: first at its box, with the
// original line, then at its ball, with the ray relative to a nearby point.
#pragma once

#include "core/math/bounds.h"
#include "core/math/least_to_square.h"
#include "core/query/ray_near_ball.h"
#include "core/query/tolerances.h"

namespace minkray {

/// A ray's line relative to the centre of a shape's bounds, in the shape's frame. Origin and
/// direction were computed as sums; `origin_size` and `direction_size` are the sums of the
/// summands' absolute values. The rounding errors are relative to these.
template <class W>
struct LineFromCentre {
  Vec3<W> origin, direction;
  W origin_size, direction_size;
};

/// A lane is open if its line may meet the bounds. In lanes that miss, `normal` is the unit normal
/// of a plane between line and bounds.
template <class W>
struct BoundsCast {
  Mask<W> open = Mask<W>(false);
  Mask<W> miss = Mask<W>(false);
  Vec3<W> normal = Vec3<W>::Zero();
};

/// Casts the line at the axis-aligned box with these half extents around the centre; the ball of
/// radius R around the centre contains the shape. Uses no division and does not move the ray, so
/// misses are found quickly. Lines that miss by less than rounding stay open; rounding grows with
/// the origin's distance.
template <class W>
[[gnu::always_inline]] inline BoundsCast<W> cast_at_box(const LineFromCentre<W>& line,
                                                        const Vec3<Lane<W>>& half_extents,
                                                        Lane<W> R, const Mask<W>& active) {
  using std::abs;
  using std::copysign;
  using T = Lane<W>;
  const Vec3<W>&o = line.origin, &d = line.direction;
  // Along d x e_k (or the opposite), the line's offset is o . (d x e_k) = (o x d)_k.
  const Vec3<W> crosswise = o.cross(d);
  const Vec3<W> size(abs(d.x()), abs(d.y()), abs(d.z()));
  const Vec3<W> h = widen<W>(half_extents);
  const W largest_term = (W(R) + line.origin_size) * line.direction_size;
  const W padding = W(tolerance::box_padding<T>) * largest_term;
  const Mask<W> by_x = abs(crosswise.x()) > h.y() * size.z() + h.z() * size.y() + padding;
  const Mask<W> by_y = abs(crosswise.y()) > h.z() * size.x() + h.x() * size.z() + padding;
  const Mask<W> by_z = abs(crosswise.z()) > h.x() * size.y() + h.y() * size.x() + padding;
  // Shorter directions may have lost digits; larger terms may overflow.
  const Mask<W> certain = (line.direction_size > W(least_to_square<T>)) &
                          (largest_term < W(std::numeric_limits<T>::max() / T(8)));
  BoundsCast<W> result;
  result.miss = active & certain & (by_x | by_y | by_z);
  result.open = active & !result.miss;
  if (any(result.miss)) {
    const Vec3<W> axis(select(by_x, copysign(W(1), crosswise.x()), W(0)),
                       select(by_y & !by_x, copysign(W(1), crosswise.y()), W(0)),
                       select(by_x | by_y, W(0), copysign(W(1), crosswise.z())));
    result.normal = select<W>(result.miss, unit<W>(Vec3<W>(d.cross(axis))), result.normal);
  }
  return result;
}

/// Casts the open lanes of `bounds` at the bounding ball of radius R; the ray must be relative to
/// the ball's centre. A ray misses if it passes by the ball, ends before the ball or begins behind
/// it. If the ray has no direction, or the shape no size, the lane ends neither open nor missed.
template <class W>
void cast_at_ball(const RayNearBall<W>& near, Lane<W> R, BoundsCast<W>& bounds) {
  using std::max;
  using std::min;
  using T = Lane<W>;
  const W nearest = min(max(W(0), near.lambda_min), near.lambda_max);
  const Vec3<W> to_ray = near.s + near.r * nearest;
  const W reached = W(R * (T(1) + tolerance::ball_padding<T>)) + near.loss;
  const Mask<W> passes = bounds.open & (to_ray.squaredNorm() > reached * reached);
  if (any(passes)) bounds.normal = select<W>(passes, unit<W>(to_ray), bounds.normal);
  bounds.miss |= passes;
  bounds.open &= (!passes) & (near.r.squaredNorm() > W(0)) & (W(R) > W(0));
}

}  // namespace minkray
