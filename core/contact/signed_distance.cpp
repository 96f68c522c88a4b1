// SPDX-License-Identifier: MIT
#include "core/contact/signed_distance.h"

#include <algorithm>

#include "core/contact/closed_pairs.h"
#include "core/contact/curved_gjk.h"
#include "core/contact/direction_bounds.h"

namespace minkray {
namespace {

/// How near the bounds are where a query is called settled, relative to the sizes. What is not is
/// looked at by branch and bound.
constexpr double settled_gap = 1e-9;

/// What all roundings of a query amount to, relative to the sizes and the middles' distance.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

/// Pairs that are asked for most are compiled for their kinds; all others look at them each time.
CoreDistance distance_of_cores(const CorePair& pair, const CoreSearch& search) {
  using enum CoreKind;
  if (pair.a.kind == box && pair.b.kind == box) return CurvedGjk<box, box>(pair, search).run();
  if (pair.a.kind == hull && pair.b.kind == hull) return CurvedGjk<hull, hull>(pair, search).run();
  return CurvedGjk<other, other>(pair, search).run();
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
CoreDistance depth_of_cores(const CorePair& pair, CoreDistance found, double gap, bool only_sign) {
  if (pair.a.kind == CoreKind::box && pair.b.kind == CoreKind::box &&
      found.status == CoreStatus::overlapping) {
    const int supports = found.supports;
    found = box_overlap(pair);
    found.supports = supports;
    if (!only_sign) find_contact(pair, found);
    return found;
  }
  const Vec3<double> a = found.a, c = found.c;
  const double upper = found.upper;
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
  const double radii = pair.a.radius + pair.b.radius, size = pair.size() + radii;
  CoreSearch search;
  search.apart = options.at_most + radii;
  search.gap = std::min(1e-12, options.tolerance);
  found = distance_of_cores(pair, search);
  if (found.lower > search.apart) return found;
  const double gap = std::clamp(options.tolerance, 1e-14, 1.0) * size;
  if (found.status == CoreStatus::separated && found.upper - found.lower <= settled_gap * size)
    return found;
  if (options.only_sign) {
    const bool is_settled =
        found.status == CoreStatus::overlapping || found.upper < radii || found.lower > radii;
    if (is_settled) return found;
  }
  return depth_of_cores(pair, found, gap / (pair.size() + pair.x.norm()),
                        options.only_sign && radii == 0);
}

}  // namespace

SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               const SignedDistanceOptions& options) {
  const CorePair pair = pair_of(a, pose_a, b, pose_b);
  const CoreDistance found = solve(pair, options);
  const double radii = pair.a.radius + pair.b.radius, size = pair.size() + radii;
  const double allowed = rounding * (size + pair.x.norm());
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
  const bool has_common_point = options.only_sign && found.status == CoreStatus::overlapping;
  if (result.upper < 0 || has_common_point)
    result.status = SignedStatus::overlapping;
  else if (result.lower > 0)
    result.status = SignedStatus::separated;
  else if (is_near)
    result.status = SignedStatus::touching;
  // From A's core to the world.
  const PlacedCore frame = placed(a, pose_a);
  result.normal = unit<double>(frame.turn * found.axis);
  result.point_a = frame.middle + frame.turn * Vec3<double>(found.a + pair.a.radius * found.axis);
  result.point_b =
      frame.middle + frame.turn * Vec3<double>(found.a + found.c - pair.b.radius * found.axis);
  return result;
}

SignedDistance signed_distance(const ContactShape& a, const ContactShape& b,
                               const SignedDistanceOptions& options) {
  return signed_distance(a, {}, b, {}, options);
}

}  // namespace minkray
