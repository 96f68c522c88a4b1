// SPDX-License-Identifier: MIT
#include "core/pair_distance/core_signed_distance.h"

#include <algorithm>

#include "core/pair/closed_pairs.h"
#include "core/pair_distance/core_distance.h"
#include "core/pair_distance/depth_direction.h"
#include "core/pair_distance/direction_bounds.h"
#include "core/pair_distance/expanding_polytope.h"
#include "core/pair_distance/meridian_bounds.h"
#include "core/pair_distance/signed_distance.h"

namespace minkray {
namespace {

/// Computes the depth by a polytope that grows from the enclosure (four points of C around the
/// origin). Returns true if the bounds met; the bounds hold in any case.
template <CoreKind A, CoreKind B>
bool expand(const CorePair& pair, double gap, const Enclosure& enclosure, CoreDistance& found) {
  ExpandingPolytope<A, B> polytope(pair, gap, found);
  const bool has_met = polytope.run(enclosure.c.data(), enclosure.a.data());
  found = polytope.found();
  return has_met;
}

/// Finds four points that enclose the origin, if the overlap is so slight that GJK did not find
/// any.
bool enclose(const CorePair& pair, double gap, CoreDistance& found, Enclosure& enclosure) {
  if (!DepthDirection::helps(pair) || found.axis.isZero(0)) return false;
  DepthDirection depth(pair);
  const auto is_sure = [&](const Enclosure& four) {
    using enum CoreKind;
    return ExpandingPolytope<other, other>(pair, 0, found).begins(four.c.data(), four.a.data());
  };
  const bool is_found = depth.enclose(found.axis, gap * pair.size(), enclosure, is_sure);
  found.supports += depth.supports();
  if (!depth.direction().isZero(0)) found.raise_lower(depth.gap(), depth.direction());
  return is_found;
}

bool depth_by_polytope(const CorePair& pair, double gap, Enclosure enclosure, CoreDistance& found) {
  constexpr double shallow = 1e-4;
  const bool is_shallow = found.lower > -shallow * pair.size();
  // For a shallow overlap, GJK's enclosure is flat up to rounding.
  Enclosure finer;
  if (is_shallow && enclose(pair, gap, found, finer)) enclosure = finer;
  if (!enclosure.is_found) {
    CoreSearch plain;
    plain.may_slide = false;
    const int supports = found.supports;
    const CoreDistance again = distance_of_cores(pair, plain, &enclosure);
    found.supports = supports + again.supports;
  }
  if (!enclosure.is_found && (is_shallow || !enclose(pair, gap, found, enclosure))) return false;
  using enum CoreKind;
  if (pair.a.kind == hull && pair.b.kind == hull)
    return expand<hull, hull>(pair, gap, enclosure, found);
  return expand<other, other>(pair, gap, enclosure, found);
}

/// Returns a lower bound of the origin's depth in the tetrahedron of four points of C; negative if
/// unknown.
double depth_within(const Enclosure& four) {
  if (!four.is_found) return -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3<double>&p = four.c[i], &q = four.c[(i + 1) % 4], &r = four.c[(i + 2) % 4],
          &opposite = four.c[(i + 3) % 4];
    const Vec3<double> n = unit<double>((q - p).cross(r - p));
    const double side = n.dot(opposite - p) < 0 ? -1 : 1;
    // Valid for any n: along n, the plane through the lowest of the three corners bounds the depth.
    least = std::min(least, -side * n.dot(p));
    least = std::min({least, -side * n.dot(q), -side * n.dot(r)});
  }
  return least;
}

/// Improves axis and points of cores that nearly touch, or whose bounds differ by more than `gap`.
/// If they nearly touch, the difference of their nearest points has too few digits to give a
/// direction. So B is moved out along the axis, where a search finds a more accurate axis and
/// points. The axis and points are also valid for B in place, and the next round moves B out along
/// the new axis.
void improve_plane(const CorePair& pair, double gap, CoreDistance& found) {
  constexpr double stand_offs[] = {1e-3, 1e-3, 1e-5, 1e-1, 1e-2};
  for (const double stand_off : stand_offs) {
    if (found.axis.isZero(0)) return;
    CorePair moved = pair;
    const Vec3<double> away = stand_off * pair.size() * found.axis;
    moved.x += away;
    CoreSearch finer;
    if (gap < finer.gap * pair.size()) finer.gap = 1e-15;
    const CoreDistance there = distance_of_cores(moved, finer);
    found.supports += there.supports + 1;
    if (there.axis.isZero(0)) return;
    found.raise_lower(there.axis.dot(nearest_along(pair, there.axis).c), there.axis);
    const Vec3<double> between = there.c - away;
    if (there.status == CoreStatus::separated && between.norm() < found.upper) {
      found.upper = between.norm();
      found.a = there.a;
      found.c = between;
    }
    if (found.upper - found.lower <= gap) break;
  }
  if (found.lower > 0) found.status = CoreStatus::separated;
}

/// Finds the contact points: the points that coincide when B is moved out along the axis until the
/// cores just touch. B is moved out a little further, where nearest points are more accurate.
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

/// Computes the depth of cores that overlap, or that touch up to rounding.
CoreDistance depth_of_cores(const CorePair& pair, Enclosure enclosure, CoreDistance found,
                            const SignedDistanceOptions& options, double gap, bool only_sign) {
  // If the overlap is less than the gap, two points this close to each other are an accurate enough
  // result.
  const double slight = gap * (pair.size() + pair.x.norm());
  if (found.status == CoreStatus::overlapping && found.lower >= -slight) {
    if (!(found.c.norm() <= slight / 2)) improve_plane(pair, settled_core_gap * pair.size(), found);
    if (found.lower <= 0 && found.c.norm() <= slight / 2) return found;
  }
  // Keeps the points of the distance search for a separated result. For an overlap, a common point
  // is usually on neither surface, so it gives no upper bound.
  const Vec3<double> a = found.a, c = found.c;
  const double upper = found.status == CoreStatus::overlapping
                           ? std::numeric_limits<double>::infinity()
                           : found.upper;
  const std::optional<CoreDistance> of_meridian = bound_along_meridian(pair, found, gap);
  if (of_meridian && !of_meridian->is_exhausted) {
    found = *of_meridian;
  } else {
    if (of_meridian) found.raise_lower(of_meridian->lower, of_meridian->axis);
    if (found.status != CoreStatus::overlapping && found.lower < 0 &&
        enclose(pair, gap, found, enclosure)) {
      found.status = CoreStatus::overlapping;
      const double depth = depth_within(enclosure);
      if (only_sign && depth > 2 * pair.rounding()) {
        found.upper = -depth;
        found.c.setZero();
        return found;
      }
    }
    if (found.status == CoreStatus::overlapping && depth_by_polytope(pair, gap, enclosure, found))
      return found;
    const int supports = found.supports;
    found.supports = 0;
    found = bound_by_directions(pair, found, {gap, options.max_supports, only_sign});
    found.supports += supports;
    if (of_meridian) found.upper = std::min(found.upper, of_meridian->upper);
  }
  if (only_sign) return found;
  if (found.lower > 0 && upper <= found.upper + settled_core_gap * pair.size()) {
    found.a = a;
    found.c = c;
    found.upper = std::min(found.upper, upper);
  } else {
    find_contact(pair, found);
  }
  return found;
}

/// Improves the direction and the points of a depth whose bounds are already close, by Newton's
/// method. Before that, the error of direction and points is about the square root of the gap
/// between the bounds. Returns true if the method succeeded; the bounds hold in any case.
bool sharpen(const CorePair& pair, CoreDistance& found) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  if (!DepthDirection::helps(pair)) return false;
  CoreSearch search;
  using enum CoreKind;
  CoreQuery<other, other> query{pair, search};
  SlidingFeatures<other, other> features(query);
  // Largest error of the direction if radii of curvature differ from the depth by a tenth of the
  // size.
  const double turn =
      std::clamp(4 * std::sqrt((found.upper - found.lower) / pair.size()), 1e-7, 1e-3);
  const bool is_found = features.sharpen(found.axis, turn);
  found.supports += query.result.supports;
  if (!is_found) return false;
  const Vec3<double>& axis = features.direction();
  const double height = axis.dot(nearest_along(pair, axis).c);
  ++found.supports;
  const double rounded = rounding * (pair.size() + pair.x.norm());
  if (!(height >= found.lower - rounded)) return false;  // found another local maximum
  found.lower = height;
  found.upper = std::max(found.upper, height);
  found.axis = axis;
  found.a = features.sharp_a();
  found.c = features.sharp_c();
  return true;
}

}  // namespace

CoreDistance core_signed_distance(const CorePair& pair, const SignedDistanceOptions& options,
                                  PairMemory* memory) {
  CoreDistance found;
  if (pair.a.kind == CoreKind::box && pair.b.kind == CoreKind::box) {
    const BoxOverlap overlap = box_overlap(pair, found);
    if (overlap == BoxOverlap::without_points && !options.only_sign) find_contact(pair, found);
    if (overlap != BoxOverlap::none) return found;
  }
  const double radii = pair.a.radius + pair.b.radius, size = pair.size() + radii;
  CoreSearch search;
  search.apart = options.at_most + radii;
  search.gap = std::min(options.is_for_derivatives ? 1e-15 : 1e-12, options.tolerance);
  search.memory = memory;
  Enclosure enclosure;
  found = distance_of_cores(pair, search, &enclosure);
  if (found.lower > search.apart) return found;
  const double gap = std::clamp(options.tolerance, 1e-14, 1.0) * size;
  const auto is_settled = [&] {
    const bool overlaps = found.status == CoreStatus::overlapping;
    const double sure = 2 * pair.rounding();
    if (options.only_sign && (found.upper < radii - sure || found.lower > radii + sure))
      return true;
    return !overlaps && found.upper - found.lower <= settled_core_gap * size;
  };
  // A common point proves an overlap if its depth exceeds the rounding errors.
  if (options.only_sign && found.status == CoreStatus::overlapping) {
    const double depth = std::max(depth_within(enclosure), 0.0);
    if (depth + radii > 2 * pair.rounding()) {
      found.upper = -depth;
      return found;
    }
    if (options.max_supports == 0) return found;
  }
  const bool is_done = is_settled() && found.status != CoreStatus::unsettled;
  if (is_done && (options.only_sign || found.upper - found.lower <= std::max(gap, pair.rounding())))
    return found;
  if (found.status != CoreStatus::overlapping && std::isfinite(found.upper)) {
    improve_plane(pair, is_done ? gap : settled_core_gap * pair.size(), found);
    if (is_settled()) return found;
  }
  // If both cores are points at the same place, the size is 0.
  const double reach = pair.size() + pair.x.norm();
  const auto depth_to = [&](double gap_of_depth) {
    return depth_of_cores(
        pair, enclosure, found, options, reach > 0 ? gap_of_depth / reach : 0,
        options.only_sign && radii == 0 && found.status != CoreStatus::overlapping);
  };
  const CoreDistance depth = depth_to(gap);
  if (!options.is_for_derivatives) return depth;
  const double finest = 1e-14 * size;
  if (depth.status != CoreStatus::overlapping || depth.upper - depth.lower <= finest) return depth;
  CoreDistance sharp = depth;
  return sharpen(pair, sharp) ? sharp : depth_to(finest);
}

}  // namespace minkray
