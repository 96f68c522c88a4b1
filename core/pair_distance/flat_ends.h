// SPDX-License-Identifier: MIT
// Closed form for cores that end in disks (cylinders, cones). Above a flat end the support point
// jumps from one side of the rim to the other, so neither GJK nor Newton's method converges.
#pragma once

#include "core/pair/core_query.h"

namespace minkray {
namespace detail {

/// Tries the axis of a flat end as the normal. Succeeds if the other core's nearest point is
/// straight above the disk.
template <CoreKind Other, CoreKind A, CoreKind B>
bool flat_end(CoreQuery<A, B>& query, const ShapeCore& disks, const ShapeCore& other,
              const Mat3<double>& to_other, const Vec3<double>& d, bool is_of_a) {
  const CorePair& pair = query.pair;
  constexpr double flat = 0.3;  // largest squared slope of d against the axis
  if (!(d.x() * d.x() + d.y() * d.y() < flat * d.z() * d.z())) return false;
  const double sign = d.z() < 0 ? -1 : 1;
  const double rim = sign > 0 ? disks.size.y() : disks.size.x(), half = disks.size.z();
  // Point p of the other core nearest to the flat end, in the frame of the disks.
  const Vec3<double> towards(0, 0, -sign);
  ++query.result.supports;
  const CoreSupport nearest = support_of_core<Other>(other, to_other * towards);
  const Vec3<double> p = is_of_a ? Vec3<double>(pair.x + pair.turn * nearest.point)
                                 : pair.to_b(nearest.point - pair.x);
  const double across = p.x() * p.x() + p.y() * p.y();
  if (!(across <= rim * rim)) return false;
  const double gap = sign * p.z() - half;
  const Vec3<double> on_end(p.x(), p.y(), sign * half);
  if (gap > 0) {
    const Vec3<double> n(0, 0, sign);
    query.result.lower = gap;
    query.result.axis = is_of_a ? n : Vec3<double>(pair.turn * -n);
    if (is_of_a) return query.end_at(CoreStatus::separated, on_end, p - on_end);
    return query.end_at(CoreStatus::separated, nearest.point, pair.turn * Vec3<double>(on_end - p));
  }
  const double here =
      half > 0 ? disks.size.x() + (disks.size.y() - disks.size.x()) * (p.z() + half) / (2 * half)
               : rim;
  if (!(std::abs(p.z()) <= half) || !(across <= here * here)) return false;
  return query.end_at(CoreStatus::overlapping, is_of_a ? p : nearest.point, Vec3<double>::Zero());
}

}  // namespace detail

/// Tries each flat end that faces the other core; d is the direction from A to B. Returns true if a
/// flat end gave a result.
template <CoreKind A, CoreKind B>
bool try_flat_ends(CoreQuery<A, B>& query, const Vec3<double>& d) {
  const CorePair& pair = query.pair;
  if constexpr (A == CoreKind::disks || A == CoreKind::other)
    if (pair.a.kind == CoreKind::disks &&
        detail::flat_end<B>(query, pair.a, pair.b, pair.turn.transpose(), d, true))
      return true;
  if constexpr (B == CoreKind::disks || B == CoreKind::other)
    if (pair.b.kind == CoreKind::disks &&
        detail::flat_end<A>(query, pair.b, pair.a, pair.turn, pair.to_b(-d), false))
      return true;
  return false;
}

}  // namespace minkray
