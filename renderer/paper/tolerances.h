// SPDX-License-Identifier: MIT
// Tolerances and limits of the papers' algorithms.
#pragma once

#include "core/query/tolerances.h"

namespace minkray::tolerance {

/// The GJK distance algorithm ends when |v|^2 - v.w <= distance_gap * |v| (|v| + R), in the letters
/// of renderer/paper/gjk_distance.h. The product v.w is a difference of numbers of size |v| (|v| +
/// R), each rounded to an epsilon of that size. The error of the distance is then a few epsilon of
/// the distance and of the objects' size.
template <class T>
inline constexpr T distance_gap = T(4) * epsilon<T>;

/// Limit of iterations of the GJK distance algorithm. On polytopes the algorithm ends without a
/// limit; the worst smooth shapes (ellipsoids of 1:1000) needed fewer than 200.
inline constexpr int distance_max_iterations = 400;

/// Limit of support points of Algorithm 1, whose nested queries needed some 1500 for grazing rays.
inline constexpr int first_solution_max_supports = 10000;

/// Distances by which shapes are moved apart to find the point of contact, relative to the sum of
/// their sizes. Hits are precise to a few epsilon, and hits of stalled casts are precise to
/// gjk_stalled.
template <class T>
inline constexpr T contact_back_off[] = {T(8) * epsilon<T>, T(64) * epsilon<T>,
                                         T(512) * epsilon<T>};

}  // namespace minkray::tolerance
