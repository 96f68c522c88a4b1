// SPDX-License-Identifier: MIT
#include "core/pair_distance/signed_distance.h"

#include <algorithm>
#include <cmath>

#include "core/pair/closed_answer.h"
#include "core/pair/closed_pairs.h"
#include "core/pair/searchable.h"
#include "core/pair_distance/core_signed_distance.h"

namespace minkray {
namespace {

/// Converts the bounds and points of the cores, as returned by `search`, to those of the shapes
/// (cores grown by their radii). Returns an unknown result for sizes outside the searchable range
/// (core/pair/searchable.h), except for balls. `distance` is the distance of the middles, with an
/// error of at most `loss`. `to_world` rotates vectors from the search's frame to the world. The
/// search's origin is A's middle, which is at `origin` in the world.
template <class Search, class ToWorld>
SignedDistance bounded(const Search& search, const ContactShape& a, const ContactShape& b,
                       double distance, double loss, const Vec3<double>& origin,
                       const ToWorld& to_world) {
  const double radius_a = a.core().radius, radius_b = b.core().radius, radii = radius_a + radius_b;
  const double size = a.core().ball + b.core().ball + radii;
  const double allowed = core_rounding * (size + distance) + loss;
  SignedDistance result;
  if (!std::isfinite(allowed)) return result;  // squares of such lengths overflow
  const bool are_balls = a.core().kind == CoreKind::point && b.core().kind == CoreKind::point;
  if (!are_balls && !are_searchable(size, distance)) return result;
  const CoreDistance found = search();
  result.supports = found.supports;
  result.is_exhausted = found.is_exhausted;
  result.has_one_direction = found.has_one_direction;
  result.lower = found.lower - radii - allowed;
  result.upper = found.upper - radii + allowed;
  if (found.status == CoreStatus::overlapping && found.upper >= 0)
    result.upper = found.c.norm() - radii + allowed;
  const bool is_from_points = found.status == CoreStatus::separated && std::isfinite(found.upper);
  result.value =
      std::clamp((is_from_points ? found.upper : found.lower) - radii, result.lower, result.upper);
  const bool is_near = result.upper - result.lower <= settled_core_gap * size + 2 * allowed;
  result.status = SignedStatus::undecided;
  if (result.upper < 0)
    result.status = SignedStatus::overlapping;
  else if (result.lower > 0)
    result.status = SignedStatus::separated;
  else if (is_near)
    result.status = SignedStatus::touching;
  const Vec3<double>& axis = to_world(found.axis);
  const Vec3<double>& on_a = to_world(found.a);
  const Vec3<double>& between = to_world(found.c);
  result.normal = unit<double>(axis);
  // If the line between the cores' points is not parallel to the normal, the radii are applied
  // along `outwards` instead of the normal, so that the bodies' points differ by `value` times the
  // normal. In closed forms that line and the normal are parallel.
  const bool is_aside = is_from_points && found.lower < found.upper && radii > 0;
  const Vec3<double> outwards =
      is_aside ? unit<double>(between - std::min(result.value, 0.0) * result.normal) : axis;
  result.point_a = origin + (on_a + radius_a * outwards);
  result.point_b = origin + (on_a + between - radius_b * outwards);
  return result;
}

/// Two bodies with the vector between their middles, which replaces both translations; `origin` is
/// A's middle in the frame of the reported points.
struct NearBodies {
  const ContactShape& a;
  const Mat3<double>& linear_a;
  const ContactShape& b;
  const Mat3<double>& linear_b;
  Between between;
  Vec3<double> origin;
};

/// Both cores are points, so both shapes are balls around their middles.
SignedDistance of_balls(const NearBodies& near) {
  const Vec3<double>& x = near.between.x;
  const auto search = [&] {
    return closed_between(Vec3<double>::Zero(), x, Vec3<double>::UnitX());
  };
  return bounded(search, near.a, near.b, x.norm(), near.between.loss, near.origin,
                 [](const Vec3<double>& v) -> const Vec3<double>& { return v; });
}

/// Both cores are points or segments: the search needs no frame of a body.
SignedDistance of_lines(const NearBodies& near) {
  const auto half = [](const ContactShape& shape, const Mat3<double>& linear) -> Vec3<double> {
    if (shape.core().kind == CoreKind::point) return Vec3<double>::Zero();
    return linear * (shape.turn().col(2) * shape.core().size.z());
  };
  const auto search = [&] {
    return between_segments(half(near.a, near.linear_a), half(near.b, near.linear_b),
                            near.between.x);
  };
  return bounded(search, near.a, near.b, near.between.x.norm(), near.between.loss, near.origin,
                 [](const Vec3<double>& v) -> const Vec3<double>& { return v; });
}

/// A's core is a point; B's is a box, or the hull of two disks (cylinder, frustum).
SignedDistance of_point_and_solid(const NearBodies& near) {
  const Mat3<double> turn = turn_in_world(near.b, near.linear_b);
  const auto search = [&] {
    CoreDistance found =
        between_solid_and_point(near.b.core(), turn.transpose() * -near.between.x,
                                deeper_by(near.a.ball_radius() + near.b.ball_radius()));
    found.axis = -found.axis;
    found.c = -found.c;
    found.a.setZero();
    return found;
  };
  return bounded(search, near.a, near.b, near.between.x.norm(), near.between.loss, near.origin,
                 [&](const Vec3<double>& v) -> Vec3<double> { return turn * v; });
}

/// Requires that A's kind is not after B's in CoreKind, since solvers are compiled for this order
/// only.
SignedDistance in_order(const NearBodies& near, const SignedDistanceOptions& options,
                        PairMemory* memory) {
  if (near.b.core().kind == CoreKind::point) return of_balls(near);
  if (is_line(near.b.core())) return of_lines(near);
  if (near.a.core().kind == CoreKind::point && is_solid(near.b.core()))
    return of_point_and_solid(near);
  const Mat3<double> turn = turn_in_world(near.a, near.linear_a);
  const CorePair pair =
      pair_of(near.a, turn, near.b, turn_in_world(near.b, near.linear_b), near.between);
  return bounded([&] { return core_signed_distance(pair, options, memory); }, near.a, near.b,
                 pair.x.norm(), pair.loss, near.origin,
                 [&](const Vec3<double>& v) -> Vec3<double> { return turn * v; });
}

void turn_round(SignedDistance& found) {
  std::swap(found.point_a, found.point_b);
  found.normal = -found.normal;
}

SignedDistance in_world(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                        const Affine<double>& pose_b, const SignedDistanceOptions& options,
                        PairMemory* memory) {
  const bool is_turned = a.core().kind > b.core().kind;
  const ContactShape &first = is_turned ? b : a, &second = is_turned ? a : b;
  const Affine<double>&of_first = is_turned ? pose_b : pose_a,
        &of_second = is_turned ? pose_a : pose_b;
  SignedDistance found = in_order(
      {first, of_first.linear, second, of_second.linear,
       between_middles(first, of_first, second, of_second), middle_in_world(first, of_first)},
      options, memory);
  if (is_turned) turn_round(found);
  return found;
}

}  // namespace

SignedDistance signed_distance(const ContactShape& a, const Mat3<double>& linear_a,
                               const ContactShape& b, const Mat3<double>& linear_b,
                               const Between& between, const SignedDistanceOptions& options,
                               PairMemory* memory) {
  if (a.core().kind <= b.core().kind)
    return in_order({a, linear_a, b, linear_b, between, Vec3<double>::Zero()}, options, memory);
  const Between back{-between.x, between.loss};
  SignedDistance found = in_order({b, linear_b, a, linear_a, back, between.x}, options, memory);
  turn_round(found);
  return found;
}

SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               const SignedDistanceOptions& options) {
  return in_world(a, pose_a, b, pose_b, options, nullptr);
}

SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               PairMemory& memory, const SignedDistanceOptions& options) {
  return in_world(a, pose_a, b, pose_b, options, &memory);
}

SignedDistance signed_distance(const ContactShape& a, const ContactShape& b,
                               const SignedDistanceOptions& options) {
  return signed_distance(a, {}, b, {}, options);
}

}  // namespace minkray
