// SPDX-License-Identifier: MIT
// What a shape's surface is made of, as its jets tell: which solver suits a shape depends on it.
#pragma once

#include "core/shape/jet.h"

namespace minkray {

enum class SurfaceKind : unsigned char {
  flat,        ///< a polytope: points are its only pieces
  ellipsoids,  ///< faces and edges between finitely many ellipsoids
  smooth,      ///< other curved surfaces, which jets only osculate
};

/// Found by asking for jets in 27 slightly tilted directions: a description that steers the
/// choice of a solver, on which no answer's correctness may depend.
template <class T, class S>
requires JetMapped<S, T> SurfaceKind surface_of(const S& shape) {
  SurfaceKind surface = SurfaceKind::flat;
  const Vec3<T> tilt(T(0.11), T(0.07), T(0.13));
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vec3<T> n = Vec3<T>(T(x), T(y), T(z)) + tilt;
        const Jet<T> jet = shape.jet(n);
        if (!jet.exact) return SurfaceKind::smooth;
        if (!jet.is_point()) surface = SurfaceKind::ellipsoids;
      }
    }
  }
  return surface;
}

}  // namespace minkray
