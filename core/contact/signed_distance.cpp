// SPDX-License-Identifier: MIT
#include "core/contact/signed_distance.h"

#include <algorithm>

#include "core/contact/closed_pairs.h"
#include "core/contact/core_distance.h"
#include "core/contact/direction_bounds.h"
#include "core/contact/expanding_polytope.h"

namespace minkray {
namespace {

/// How near the bounds are where a query is called settled, relative to the sizes. What is not is
/// looked at by branch and bound.
constexpr double settled_gap = 1e-9;

/// What all roundings of a query amount to, relative to the sizes and the middles' distance.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

/// The depth by a polytope that grows from there. Returns whether its bounds met; they hold anyway.
template <CoreKind A, CoreKind B>
bool expand(const CorePair& pair, double gap, const Enclosure& enclosure, CoreDistance& found) {
  ExpandingPolytope<A, B> polytope(pair, gap, found);
  const bool has_met = polytope.run(enclosure.c, enclosure.a);
  found = polytope.found();
  return has_met;
}

bool depth_by_polytope(const CorePair& pair, double gap, Enclosure enclosure, CoreDistance& found) {
  if (!enclosure.is_found) {
    CoreSearch plain;
    plain.may_slide = false;
    const int supports = found.supports;
    const CoreDistance again = distance_of_cores(pair, plain, &enclosure);
    found.supports = supports + again.supports;
    if (!enclosure.is_found) return false;
  }
  using enum CoreKind;
  if (pair.a.kind == hull && pair.b.kind == hull)
    return expand<hull, hull>(pair, gap, enclosure, found);
  return expand<other, other>(pair, gap, enclosure, found);
}

/// Where the cores nearly touch, what is between their nearest points is short of digits for a
/// direction. B stands off along the axis: the plane that is found there is one here, too.
void improve_plane(const CorePair& pair, CoreDistance& found) {
  constexpr double stand_offs[] = {1e-3, 1e-5};
  for (const double stand_off : stand_offs) {
    if (found.axis.isZero(0)) return;
    CorePair moved = pair;
    moved.x += stand_off * pair.size() * found.axis;
    const CoreDistance there = distance_of_cores(moved, CoreSearch{});
    found.supports += there.supports + 1;
    if (there.axis.isZero(0)) return;
    found.raise_lower(there.axis.dot(nearest_along(pair, there.axis).c), there.axis);
    if (found.upper - found.lower <= settled_gap * pair.size()) break;
  }
  if (found.lower > 0 && found.status == CoreStatus::unsettled)
    found.status = CoreStatus::separated;
}

/// The points of first contact when B is moved out along the axis: the nearest points of the two
/// once B stands off by a fair distance, where they are found most exactly.
void find_contact(const CorePair& pair, CoreDistance& found) {
  constexpr double stand_off = 1e-3;
  const double apart = stand_off * pair.size();
  CorePair moved = pair;
  moved.x += (apart - found.lower) * found.axis;
  const CoreDistance nearest = distance_of_cores(moved, CoreSearch{});
  found.supports += nearest.supports;
  found.a = nearest.a;
  found.c = nearest.c - (apart - found.lower) * found.axis;
}

/// The depth of cores that were found to overlap, or whose distance rounding hides.
CoreDistance depth_of_cores(const CorePair& pair, const Enclosure& enclosure, CoreDistance found,
                            double gap, bool only_sign) {
  // A common point that was found is of neither's surface.
  const Vec3<double> a = found.a, c = found.c;
  const double upper = found.status == CoreStatus::overlapping
                           ? std::numeric_limits<double>::infinity()
                           : found.upper;
  if (found.status == CoreStatus::overlapping && !only_sign &&
      depth_by_polytope(pair, gap, enclosure, found))
    return found;
  const int supports = found.supports;
  DirectionSearch search;
  search.gap = gap;
  search.only_sign = only_sign;
  found.supports = 0;
  found = bound_by_directions(pair, found, search);
  found.supports += supports;
  if (found.lower > 0) found.status = CoreStatus::separated;
  if (only_sign) return found;
  if (found.lower > 0 && upper <= found.upper + settled_gap * pair.size()) {
    found.a = a;
    found.c = c;
    found.upper = std::min(found.upper, upper);
  } else {
    find_contact(pair, found);
  }
  return found;
}

CoreDistance solve(const CorePair& pair, const SignedDistanceOptions& options) {
  CoreDistance found;
  if (closed_distance(pair, found)) return found;
  if (pair.a.kind == CoreKind::box && pair.b.kind == CoreKind::box) {
    const BoxOverlap overlap = box_overlap(pair, found);
    if (overlap == BoxOverlap::without_points && !options.only_sign) find_contact(pair, found);
    if (overlap != BoxOverlap::none) return found;
  }
  const double radii = pair.a.radius + pair.b.radius, size = pair.size() + radii;
  CoreSearch search;
  search.apart = options.at_most + radii;
  search.gap = std::min(1e-12, options.tolerance);
  Enclosure enclosure;
  found = distance_of_cores(pair, search, &enclosure);
  if (found.lower > search.apart) return found;
  const double gap = std::clamp(options.tolerance, 1e-14, 1.0) * size;
  const auto is_settled = [&] {
    const bool overlaps = found.status == CoreStatus::overlapping;
    if (options.only_sign && (overlaps || found.upper < radii || found.lower > radii)) return true;
    return !overlaps && found.upper - found.lower <= settled_gap * size;
  };
  if (is_settled() && found.status != CoreStatus::unsettled) return found;
  if (found.status != CoreStatus::overlapping && std::isfinite(found.upper)) {
    improve_plane(pair, found);
    if (is_settled()) return found;
  }
  return depth_of_cores(pair, enclosure, found, gap / (pair.size() + pair.x.norm()),
                        options.only_sign && radii == 0);
}

/// Bounds and points of the shapes, with their radii. `distance` is that of the middles; `to_world`
/// turns from the frame of what was found, which stands about A's middle.
template <class ToWorld>
SignedDistance told(const CoreDistance& found, const ContactShape& a, const ContactShape& b,
                    double distance, const Affine<double>& pose_a, bool only_sign,
                    const ToWorld& to_world) {
  const double radius_a = a.core().radius, radius_b = b.core().radius, radii = radius_a + radius_b;
  const double size = a.core().ball + b.core().ball + radii;
  const double allowed = rounding * (size + distance);
  SignedDistance result;
  result.supports = found.supports;
  result.lower = found.lower - radii - allowed;
  result.upper = found.upper - radii + allowed;
  if (found.status == CoreStatus::overlapping && found.upper >= 0)
    result.upper = found.c.norm() - radii + allowed;
  const bool is_from_points = found.status == CoreStatus::separated && std::isfinite(found.upper);
  result.value =
      std::clamp((is_from_points ? found.upper : found.lower) - radii, result.lower, result.upper);
  const bool is_near = result.upper - result.lower <= settled_gap * size + 2 * allowed;
  result.status = SignedStatus::undecided;
  const bool has_common_point = only_sign && found.status == CoreStatus::overlapping;
  if (result.upper < 0 || has_common_point)
    result.status = SignedStatus::overlapping;
  else if (result.lower > 0)
    result.status = SignedStatus::separated;
  else if (is_near)
    result.status = SignedStatus::touching;
  const Vec3<double> middle = pose_a(a.middle());
  const Vec3<double>& axis = to_world(found.axis);
  const Vec3<double>& on_a = to_world(found.a);
  const Vec3<double>& between = to_world(found.c);
  result.normal = unit<double>(axis);
  result.point_a = middle + (on_a + radius_a * axis);
  result.point_b = middle + (on_a + between - radius_b * axis);
  return result;
}

}  // namespace

SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               const SignedDistanceOptions& options) {
  if (a.core().kind > b.core().kind) {
    // The solvers are compiled for one order of two kinds.
    SignedDistance turned = signed_distance(b, pose_b, a, pose_a, options);
    std::swap(turned.point_a, turned.point_b);
    turned.normal = -turned.normal;
    return turned;
  }
  if (is_line(a.core()) && is_line(b.core())) {
    // In the world: no frame of either is needed.
    const Vec3<double> half_a = pose_a.linear * (a.turn().col(2) * a.core().size.z()),
                       half_b = pose_b.linear * (b.turn().col(2) * b.core().size.z()),
                       x = between_middles(a, pose_a, b, pose_b);
    return told(between_segments(half_a, half_b, x), a, b, x.norm(), pose_a, options.only_sign,
                [](const Vec3<double>& v) -> const Vec3<double>& { return v; });
  }
  const CorePair pair = pair_of(a, pose_a, b, pose_b);
  const CoreDistance found = solve(pair, options);
  const Mat3<double> turn = pose_a.linear * a.turn();
  return told(found, a, b, pair.x.norm(), pose_a, options.only_sign,
              [&](const Vec3<double>& v) -> Vec3<double> { return turn * v; });
}

SignedDistance signed_distance(const ContactShape& a, const ContactShape& b,
                               const SignedDistanceOptions& options) {
  return signed_distance(a, {}, b, {}, options);
}

}  // namespace minkray
