// SPDX-License-Identifier: MIT
// Result of a distance query: the distance, its lower bound and the plane that proves this bound,
// the closest points, and the cost.
#pragma once

#include <span>
#include <string_view>

#include "core/math/vec.h"
#include "core/support/named_kind.h"

namespace minkray {

enum class DistanceStatus : unsigned char {
  separated,    ///< a plane lies between A and B; distance > 0
  overlapping,  ///< a common point was found, to within rounding; distance 0
  exhausted,    ///< the solver did not converge; the distance lies in [lower, distance]
};

constexpr std::string_view name_of(DistanceStatus status) {
  return name_at({"separated", "overlapping", "exhausted"}, status);
}

/// Result for objects A and B. Points and the axis are in the frame of the query.
template <class T, int Dim>
struct DistanceResult {
  DistanceStatus status = DistanceStatus::exhausted;
  T distance = T(0);  ///< |v|, the distance of the two points: an upper bound, up to rounding
  T lower = T(0);     ///< max v.w/|v|, the gap between two parallel planes
  /// |v|^2 - v.w, an upper bound of the squared distance of v from v(A - B), the point of A - B
  /// closest to the origin, which v approximates (van den Bergen, 2004). May be infinite; 0 if
  /// overlapping.
  T certificate = T(0);
  Vec<T, Dim> point_a = Vec<T, Dim>::Zero();  ///< in A, closest to B; overlapping: in both
  Vec<T, Dim> point_b = Vec<T, Dim>::Zero();  ///< in B, closest to A; overlapping: in both
  /// Unit normal of the separating planes, from A to B; zero if there are none.
  Vec<T, Dim> axis = Vec<T, Dim>::Zero();
  int iterations = 0;
  int supports = 0;  ///< support points of A - B, each from one of A and one of B
  int backups = 0;  ///< number of times the distance subalgorithm fell back on its backup procedure
};

/// One iteration of the distance algorithm, in the letters of van den Bergen (2004), for C = {x} -
/// (A - B).
template <class T, int Dim>
struct DistanceIteration {
  Vec<T, Dim> v;                        ///< the direction of the support call
  Vec<T, Dim> w;                        ///< the support point, in C
  Vec<T, Dim> v_next;                   ///< the point of the new simplex closest to the origin
  T lower;                              ///< lower bound of the distance so far
  T upper;                              ///< |v_next|, or |v| if the loop ends at w
  std::span<const Vec<T, Dim>> before;  ///< the simplex before w was added
  std::span<const Vec<T, Dim>> after;   ///< the vertices of the smallest face that contains v_next
};

}  // namespace minkray
