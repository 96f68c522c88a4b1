// SPDX-License-Identifier: MIT
// Ray cast with any of the models: finds the first hit of the infinite line with the shape, and
// converts it to the result of a ray, which has a beginning and an end. For one ray, or for a
// packet of rays.
#pragma once

#include "core/model/line_cast.h"
#include "core/query/result.h"

namespace minkray {

/// CastResult (core/query/result.h) in lanes. A lane that is neither hit, inside nor miss is
/// exhausted.
template <class W>
struct CastLanes {
  Mask<W> hit = Mask<W>(false);
  Mask<W> inside = Mask<W>(false);
  Mask<W> miss = Mask<W>(false);
  /// Hits of the model whose t has no upper bound by points of the shape.
  Mask<W> by_model = Mask<W>(false);
  /// Inside, but between planes so nearly parallel to the ray that rounding decides, as for a line
  /// within a face.
  Mask<W> uncertain = Mask<W>(false);
  W t_base = W(0), t_offset = W(0), offset_lo = W(0), offset_hi = W(0);
  Vec3<W> normal = Vec3<W>::Zero();
  W supports = W(0);
};

/// Casts a ray at a shape. The ray must meet the shape's bounds. The ray is relative to the
/// bounding ball's centre; half_extents are the bounding box's. make_model(s, r) makes a model of
/// the shape seen from s along r. Only `castable` lanes are cast.
template <class W, class MakeModel, class Observer>
CastLanes<W> model_cast(const MakeModel& make_model, const RayNearBall<W>& near,
                        const Ball<Lane<W>>& ball, const Vec3<Lane<W>>& half_extents,
                        const Mask<W>& castable, int max_iterations, Observer&& observer) {
  using std::copysign;
  using std::max;
  using std::min;
  using std::sqrt;
  using T = Lane<W>;
  const T R = ball.radius;
  CastLanes<W> result;
  result.t_base = near.t_base;

  // Finds where the line enters the shape.
  const Vec3<W>& s = near.s;
  const Vec3<W>& r = near.r;
  const W depth =
      sqrt(max(W(W(R) * W(R) - s.squaredNorm()), W(0))) + W(tolerance::ball_padding<T> * R);
  const auto watch = [&](const W& direction) {
    if constexpr (std::is_same_v<std::remove_cvref_t<Observer>, NoObserver>) {
      return NoObserver();
    } else {
      return [&, direction](const W& lambda, const Vec3<W>& n, const Vec3<W>& p) {
        const W at = direction * lambda;
        const Vec3<W> x = s + r * at, point = s + p;
        observer(CastIteration<T>{at, x, n, point, x - point, std::span<const Vec3<T>>()});
      };
    }
  };
  const W end = min(depth, near.lambda_max);
  const auto first_along = [&](const Vec3<W>& from, const Vec3<W>& direction, const W& until,
                               const Mask<W>& open, const W& sign) {
    auto model = make_model(from, direction);
    return first_on_line<W>(model, half_extents, until, R, open, max_iterations, watch(sign));
  };
  // A line that is tangent within rounding is replaced by a line slightly deeper in the shape,
  // which enters at a larger angle.
  const auto not_touching = [&](const LineHit<W>& found, const Vec3<W>& direction, const W& until,
                                const W& sign) {
    const Vec3<W> pushed = s - found.normal * W(tolerance::tangent_push<T> * R);
    LineHit<W> again = first_along(pushed, direction, until, found.tangent, sign);
    again.supports += found.supports;
    // If the shape is thinner than the push, the new line may pass the shape on the other side.
    // This does not prove that the original line misses.
    again.miss &= !(again.normal.dot(found.normal) < W(0));
    // The hit is where the original line crosses the plane that was found. This is later than the
    // new line's hit, but not beyond the end of the shape or the ray.
    auto model = make_model(s, direction);
    const Vec3<W> ahead = model.to_frame(direction);  // NOLINT: of some models no reference
    const W last = model.support(ahead, found.tangent).support_function(ahead);
    again.supports += select(found.tangent, W(1), W(0));
    const W slope = -again.normal.dot(direction);
    const Mask<W> crosses = again.hit & (slope > W(tolerance::least_slope<T>));
    const W push = again.normal.dot(found.normal) * W(tolerance::tangent_push<T> * R);
    const W later = again.lambda + push / select(crosses, slope, W(1));
    const W latest = max(again.lambda, min(last, until));
    again.lambda = select(crosses & (later > again.lambda), min(later, latest), again.lambda);
    again.lambda_above = max(again.lambda, again.lambda_above);
    return again;
  };
  const auto first_of = [&](const Vec3<W>& direction, const W& until, const Mask<W>& open,
                            const W& sign) {
    LineHit<W> found = first_along(s, direction, until, open, sign);
    if (any(found.tangent))
      found = pick(found.tangent, not_touching(found, direction, until, sign), found);
    return found;
  };
  const LineHit<W> entry = first_of(r, end, castable, W(1));
  result.supports = entry.supports;
  result.normal = entry.normal;
  result.miss = entry.miss;
  // If the plane cuts the line beyond the ball's far side, adds the ball's tangent plane there.
  // Together the two planes exclude the entire line; the sum of their normals gives a plane along
  // the line.
  const W z = -entry.normal.dot(r);
  if (any(entry.miss)) {
    const Vec3<W> out = s + r * depth;
    const W along = out.dot(r);
    const Mask<W> beyond_ball = entry.miss & (z > W(0)) & (end == depth) & (along > W(0));
    const W weight = z / select(along > W(0), along, W(1));
    result.normal =
        select<W>(beyond_ball, unit<W>(Vec3<W>(entry.normal + out * weight)), result.normal);
  }
  const Mask<W> enters = entry.hit & (entry.lambda >= near.lambda_min);
  result.hit = enters;
  // If planes are so nearly parallel to the ray that their rounding is large along the ray, the
  // model's hit is the better result, since it lies between points of the shape. This does not
  // apply if the model's own plane is even more nearly parallel.
  Mask<W> bounded = entry.lambda_above < W(std::numeric_limits<T>::infinity());
  const W gap = select(bounded, W(entry.lambda_above - entry.lambda), W(0));
  bounded &= gap * z <= W(T(4) * tolerance::jet_gap<T> * R);
  // If the two hits are far apart, the model had only a plane nearly parallel to the ray, which
  // proves no hit.
  result.hit &= bounded | !(entry.lambda_above < W(std::numeric_limits<T>::infinity()));
  result.t_offset = near.t_offset(select(bounded, entry.lambda_above, entry.lambda));
  // Both bounds include the rounding of a plane's offset, divided by the plane's slope.
  const W rounding =
      (W(tolerance::plane_rounding<T> * R) + near.loss) / max(z, W(tolerance::least_slope<T>));
  // On reversed rays, t decreases.
  const W digits = copysign(near.offset_rounding(result.t_offset), near.t_per_length);
  result.offset_lo = near.t_offset(entry.lambda - rounding) - digits;
  result.by_model = result.hit & !(entry.lambda_above < W(std::numeric_limits<T>::infinity()));
  result.offset_hi = near.t_offset(W(entry.lambda_above + rounding)) + digits;

  // If the line enters before the ray begins, finds where the line leaves.
  const Mask<W> began = entry.hit & !enters;
  if (!any(began)) return result;
  const Vec3<W> back = -r;
  const LineHit<W> exit = first_of(back, W(-near.lambda_min), began, W(-1));
  result.supports += exit.supports;
  const Mask<W> left = began & (exit.miss | (exit.hit & (-exit.lambda < near.lambda_min)));
  result.miss |= left;
  result.normal = select<W>(left, exit.normal, result.normal);
  result.inside = began & exit.hit & !left;
  constexpr T uncertain = tolerance::uncertain_smooth_slope<T>;
  if (uncertain != T(0))
    result.uncertain =
        result.inside & !((z >= W(uncertain)) & (exit.normal.dot(r) >= W(uncertain)));
  const W start = near.t_offset(near.lambda_min);
  result.t_offset = select(result.inside, start, result.t_offset);
  result.offset_lo = select(result.inside, start, result.offset_lo);
  result.offset_hi = select(result.inside, start, result.offset_hi);
  result.normal = select<W>(result.inside, Vec3<W>::Zero(), result.normal);
  return result;
}

/// Result of a single ray.
template <class T>
CastResult<T> result_of(const CastLanes<T>& lanes) {
  CastResult<T> result;
  result.status = lanes.hit      ? Status::hit
                  : lanes.inside ? Status::inside
                  : lanes.miss   ? Status::miss
                                 : Status::exhausted;
  result.t_base = lanes.t_base;
  result.t_offset = lanes.t_offset;
  result.offset_lo = lanes.offset_lo;
  result.offset_hi = lanes.offset_hi;
  result.normal = lanes.normal;
  result.iterations = result.supports = static_cast<int>(lanes.supports);
  return result;
}

}  // namespace minkray
