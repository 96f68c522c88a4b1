// SPDX-License-Identifier: MIT
// Reports the steps of a solver, one call per iteration: for traces, pictures and heatmaps.
#pragma once

#include <functional>
#include <span>

#include "core/math/vec.h"

namespace minkray {

/// One iteration, in the letters of van den Bergen (2004). Positions are relative to the centre of
/// the shape's ball.
template <class T>
struct CastIteration {
  T lambda;   ///< lower bound of the hit; 0 at the ray's point closest to the centre
  Vec3<T> x;  ///< point of the ray at lambda
  Vec3<T> v;  ///< the direction of the support call
  Vec3<T> p;  ///< the support point
  Vec3<T> w;  ///< x - p
  std::span<const Vec3<T>> simplex;  ///< the support points kept after the iteration
};

using CastObserver = std::function<void(const CastIteration<double>&)>;

/// Ignores all iterations, at no cost.
struct NoObserver {
  template <class T>
  void operator()(const CastIteration<T>&) const {}
};

}  // namespace minkray
