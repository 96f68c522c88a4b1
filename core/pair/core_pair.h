// SPDX-License-Identifier: MIT
// Two cores A and B in A's frame, and the queries of the solvers on C, all differences b - a of a
// point of B and one of A: the distance of the shapes is that of C from the origin, and where they
// overlap, their penetration depth is how deep the origin lies in C. Either way it is, signed, the
// most that n.c can be kept above over all c of C, over all unit vectors n.
#pragma once

#include "core/pair/core_support.h"
#include "core/pair/pair_memory.h"
#include "core/query/tolerances.h"

namespace minkray {

/// Sum of all roundings of a query, relative to the sizes and the middles' distance.
inline constexpr double core_rounding = 16 * std::numeric_limits<double>::epsilon();

struct CorePair {
  const ShapeCore& a;
  const ShapeCore& b;
  Mat3<double> turn;  ///< from B's frame to A's
  Vec3<double> x;     ///< B's middle in A's frame
  double loss = 0;    ///< by how much that may be off: what the bodies' places have cost

  /// Radii of balls around the middles: what roundings are relative to.
  double size() const { return a.ball + b.ball; }
  double radii() const { return a.radius + b.radius; }
  /// Error bound of a gap between the grown cores.
  double rounding() const { return core_rounding * (size() + radii() + x.norm()) + loss; }
  Vec3<double> to_b(const Vec3<double>& d) const { return turn.transpose() * d; }
};

/// A point c = b - a of C, in A's frame, and the features that a and b lie on.
struct DifferencePoint {
  Vec3<double> c;
  Vec3<double> a;
  int feature_a;
  int feature_b;
};

/// The point of C least far along d: b is furthest along -d, a along d.
template <CoreKind A, CoreKind B>
inline DifferencePoint nearest_along(const CorePair& pair, const Vec3<double>& d) {
  const CoreSupport a = support_of_core<A>(pair.a, d),
                    b = support_of_core<B>(pair.b, pair.to_b(-d));
  return {pair.x + pair.turn * b.point - a.point, a.point, a.feature, b.feature};
}

/// Looks up the cores' kinds in each call.
inline DifferencePoint nearest_along(const CorePair& pair, const Vec3<double>& d) {
  return nearest_along<CoreKind::other, CoreKind::other>(pair, d);
}

enum class CoreStatus : unsigned char {
  separated,    ///< the plane `axis` lies between the two
  overlapping,  ///< a common point was found
  unsettled,    ///< rounding ended the search: the bounds hold, but need not meet
};

/// The distance of two cores. The bounds do not allow for rounding.
struct CoreDistance {
  CoreStatus status = CoreStatus::unsettled;
  double lower = -std::numeric_limits<double>::infinity();  ///< axis.c is no less
  double upper = std::numeric_limits<double>::infinity();   ///< |c| of a point of C
  Vec3<double> axis = Vec3<double>::Zero();                 ///< of unit length, from A to B
  Vec3<double> a = Vec3<double>::Zero();                    ///< a point of A, in its frame,
  Vec3<double> c = Vec3<double>::Zero();                    ///< and from it to a point of B
  int supports = 0;                                         ///< of C
  bool is_exhausted = false;  ///< the budget ended the search, before the bounds met
  /// True for overlapping cores if no other direction is nearly as good: see deeper_by().
  bool has_one_direction = false;

  void raise_lower(double bound, const Vec3<double>& unit_axis) {
    if (!(bound > lower)) return;
    lower = bound;
    axis = unit_axis;
  }
};

/// Distance that B is moved in along the axis, to find other directions of the depth: each of them
/// that leans by an angle from the axis gains by its cosine only. A depth that has gained all but
/// `leaning` of the way has one direction.
inline double deeper_by(const CorePair& pair) {
  constexpr double step = 1e-4;  // of the sizes
  return step * (pair.size() + pair.radii());
}
inline constexpr double leaning = 1e-4;  ///< 1 - cos of the angle between two directions of note

/// When a search may end.
struct CoreSearch {
  double gap = 1e-12;  ///< upper - lower, relative to the size
  /// Once the distance is known to be above `apart`, the query ends. Infinite: never.
  double apart = std::numeric_limits<double>::infinity();
  int max_turns = 200;
  bool may_slide = true;  ///< curved surfaces are searched to second order
  /// Start of the search, if it is not empty; receives its end.
  PairMemory* memory = nullptr;
};

}  // namespace minkray
