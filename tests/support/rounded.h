// SPDX-License-Identifier: MIT
// Rounding of rays to float and back by functions that are not inlined. GCC 12 at -O2 drops such a
// pair of conversions for two neighbouring numbers of a struct: 0.7 stays 0.7 in two of three.
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
