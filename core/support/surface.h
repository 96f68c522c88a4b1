// SPDX-License-Identifier: MIT
// Classifies a shape's surface by its jets, to choose a solver.
#pragma once

#include "core/support/jet.h"

namespace minkray {

enum class SurfaceKind : unsigned char {
  flat,        ///< a polytope: all jets are points
  translates,  ///< the convex hull of finitely many translates of one ellipsoid
  ellipsoids,  ///< the convex hull of finitely many ellipsoids
  smooth,      ///< one curved patch; jets only osculate
  mixed,       ///< several patches; some jets only osculate
};

/// Number of directions that tilted_direction() gives.
inline constexpr int tilted_directions = 27;

/// Directions to a cube's faces, edges and corners, slightly tilted, since the exact directions are
/// special cases for many shapes.
template <class T>
Vec3<T> tilted_direction(int i) {
  const int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
  return Vec3<T>(T(x) + T(0.11), T(y) + T(0.07), T(z) + T(0.13));
}

/// Classifies by the jets in 27 slightly tilted directions. The result may guide the choice of a
/// solver, but the correctness of results must not depend on it.
template <class T, class S>
requires JetMapped<S, T> SurfaceKind surface_of(const S& shape) {
  bool all_points = true, all_exact = true, all_inexact = true, one_patch = true;
  bool one_body = true;
  Jet<T> first;
  for (int i = 0; i < tilted_directions; ++i) {
    const Jet<T> jet = shape.jet(tilted_direction<T>(i));
    if (i == 0) first = jet;
    all_points = all_points && jet.exact && jet.is_point();
    all_exact = all_exact && jet.exact;
    all_inexact = all_inexact && !jet.exact;
    one_patch = one_patch && jet.c == first.c;
    one_body = one_body && jet.F == first.F;
  }
  if (all_points) return SurfaceKind::flat;
  if (all_exact) return one_body ? SurfaceKind::translates : SurfaceKind::ellipsoids;
  return all_inexact && one_patch ? SurfaceKind::smooth : SurfaceKind::mixed;
}

}  // namespace minkray
