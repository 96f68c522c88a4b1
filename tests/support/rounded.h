// SPDX-License-Identifier: MIT
// Rounding to float and back that does round. GCC 12 at -O2 drops the pair of conversions for two
// neighbouring numbers of a struct (its vectoriser pairs them, and then sees the identity):
//
//   struct D { double x, y, z; };  struct F { float x, y, z; };
//   D twice(const D& a) { F f{(float)a.x, (float)a.y, (float)a.z}; return {f.x, f.y, f.z}; }
//
// returns 0.7 for 0.7 in two of the three. A test that meant to repeat a query of float in double
// made a different query. Across a call that is not inlined nothing is dropped.
#pragma once

#include "core/math/ray.h"

namespace minkray::testing {

template <class T>
[[gnu::noinline]] Ray<T> rounded_to(const Ray<double>& ray) {
  return {ray.origin.cast<T>(), ray.direction.cast<T>(), static_cast<T>(ray.t_max)};
}

template <class T>
[[gnu::noinline]] Ray<double> in_double(const Ray<T>& ray) {
  return {ray.origin.template cast<double>(), ray.direction.template cast<double>(),
          static_cast<double>(ray.t_max)};
}

}  // namespace minkray::testing
