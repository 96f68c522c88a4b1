// SPDX-License-Identifier: MIT
// Every tolerance of the solvers, with its unit and its reason. All are relative: to the shape's
// size, or to the numbers they are compared with.
#pragma once

#include <limits>

namespace minkray::tolerance {

/// Machine epsilon: the distance from 1 to the next number.
template <class T>
inline constexpr T epsilon = std::numeric_limits<T>::epsilon();

/// eps_tol of the GJK ray cast: the loop ends when |v|^2 <= eps_tol * max|x - p|^2 (a ratio of
/// squared lengths). The paper proposes ten times the machine epsilon, for errors of |v|^2 in
/// proportion to max|x-p|^2, as Johnson's determinants have them. Our closest point is rounded
/// to a few epsilon of |x - p| itself, so its square may be asked for.
template <class T>
inline constexpr T gjk_squared = T(16) * epsilon<T> * T(16) * epsilon<T>;

/// Support points are themselves rounded to the shape's size R, however close to x they lie: the
/// loop also ends when |v| <= this * R.
template <class T>
inline constexpr T gjk_rounding = T(4) * epsilon<T>;

/// Where |v| no longer shrinks and the lower bound no longer moves, rounding has the last word: a
/// hit if |v| <= this * R, exhausted otherwise. Nearly flat simplices lose up to six bits more than
/// single support points.
template <class T>
inline constexpr T gjk_stalled = T(256) * epsilon<T>;

/// A tetrahedron lower than this, as the sine of the angle between its face and the edge to its fourth
/// vertex, is flat: a normal and a dot product are rounded by about as much.
template <class T>
inline constexpr T flat_simplex = T(16) * epsilon<T>;

/// The GJK ray cast converges linearly: on smooth shapes it was seen to need 60 support points for
/// the tolerance above, and up to twice that for extents of 1:1000.
inline constexpr int gjk_max_iterations = 1000;

/// How far beyond its radius a bounding ball is still taken for hit, relative to the radius.
template <class T>
inline constexpr T ball_padding = T(8) * epsilon<T>;

}  // namespace minkray::tolerance
