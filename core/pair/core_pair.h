// SPDX-License-Identifier: MIT
// Two cores A and B in A's frame, and the solvers' queries on C, the set of all b - a with a in A
// and b in B. The distance of the cores is the distance of C from the origin. If the cores overlap,
// their penetration depth is the depth of the origin in C. The signed distance is the maximum of
// g(n) over all unit vectors n, where g(n) is the minimum of n.c over c in C.
#pragma once

#include "core/pair/core_support.h"
#include "core/pair/pair_memory.h"
#include "core/query/tolerances.h"

namespace minkray {

/// Bound of all rounding errors of a query, relative to the sum of the shapes' sizes and the
/// distance of the middles.
inline constexpr double core_rounding = 16 * std::numeric_limits<double>::epsilon();

struct CorePair {
  const ShapeCore& a;
  const ShapeCore& b;
  Mat3<double> turn;  ///< rotation from B's frame to A's frame
  Vec3<double> x;     ///< B's middle in A's frame
  double loss = 0;    ///< error bound of x: rounding of the bodies' positions
  /// Bound of the other rounding errors, relative to the sizes and the distance.
  double relative_rounding = core_rounding;

  /// Sum of the radii of the cores' bounding balls. Rounding errors are relative to this sum.
  double size() const { return a.ball + b.ball; }
  /// Sum of the radii by which the cores are grown.
  double radii() const { return a.radius + b.radius; }
  /// Error bound of a gap between the shapes (cores grown by their radii).
  double rounding() const { return relative_rounding * (size() + radii() + x.norm()) + loss; }
  /// Converts a direction from A's frame to B's frame.
  Vec3<double> to_b(const Vec3<double>& d) const { return turn.transpose() * d; }
};

/// A point c = b - a of C, in A's frame, and the features that a and b lie on. The point b is in
/// B's frame.
struct DifferencePoint {
  Vec3<double> c;
  Vec3<double> a, b;
  int feature_a, feature_b;
};

/// Returns the point c = b - a of C with the least d.c: b is the point of B furthest along -d, and
/// a that of A furthest along d.
template <CoreKind A, CoreKind B>
inline DifferencePoint nearest_along(const CorePair& pair, const Vec3<double>& d) {
  const CoreSupport a = support_of_core<A>(pair.a, d),
                    b = support_of_core<B>(pair.b, pair.to_b(-d));
  return {pair.x + pair.turn * b.point - a.point, a.point, b.point, a.feature, b.feature};
}

/// Same for cores whose kinds are not known when compiling: each call looks up the kinds.
inline DifferencePoint nearest_along(const CorePair& pair, const Vec3<double>& d) {
  return nearest_along<CoreKind::other, CoreKind::other>(pair, d);
}

enum class CoreStatus : unsigned char {
  separated,    ///< a plane with the normal `axis` separates the cores
  overlapping,  ///< a common point was found
  unsettled,    ///< rounding ended the search: the bounds hold, but may be far apart
};

/// Result of a search for the distance of two cores. The bounds do not include rounding.
struct CoreDistance {
  CoreStatus status = CoreStatus::unsettled;
  double lower = -std::numeric_limits<double>::infinity();  ///< minimum of axis.c over C
  double upper = std::numeric_limits<double>::infinity();   ///< length of the vector `c` below
  Vec3<double> axis = Vec3<double>::Zero();                 ///< unit vector from A to B
  Vec3<double> a = Vec3<double>::Zero();                    ///< nearest point of A, in A's frame
  Vec3<double> c = Vec3<double>::Zero();  ///< vector from a to the nearest point of B
  int supports = 0;                       ///< number of support points of C computed
  bool is_exhausted = false;  ///< the search ran out of support points before the bounds met
  /// True if the cores overlap and it is proven that no other direction gives nearly the same depth
  /// (see deeper_by).
  bool has_one_direction = false;

  void raise_lower(double bound, const Vec3<double>& unit_axis) {
    if (!(bound > lower)) return;
    lower = bound;
    axis = unit_axis;
  }
};

/// Returns the distance by which B is moved deeper along the axis, to test whether other directions
/// also have the least depth. The depth along another direction grows by this distance times the
/// cosine of the angle between that direction and the axis. If the least depth grows by at least 1
/// - `leaning` of the distance, the direction of the least depth is unique.
inline double deeper_by(double sizes) {
  constexpr double step = 1e-4;
  return step * sizes;
}
inline double deeper_by(const CorePair& pair) {
  return deeper_by(pair.size() + pair.radii());
}
/// Least value of 1 - cos(angle) between directions that count as different.
inline constexpr double leaning = 1e-4;

/// Criteria for the end of a search.
struct CoreSearch {
  double gap = 1e-12;  ///< ends if upper - lower is at most this, relative to the size
  /// The search also ends once the distance is proven to be above `apart`.
  double apart = std::numeric_limits<double>::infinity();
  int max_turns = 200;    ///< maximum number of iterations
  bool may_slide = true;  ///< allows second-order steps on curved surfaces (sliding_features.h)
  /// If not null, the search starts from this state if there is one, and stores its final state
  /// there.
  PairMemory* memory = nullptr;
};

}  // namespace minkray
