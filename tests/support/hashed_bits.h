// SPDX-License-Identifier: MIT
// Hashes of what queries answer, and of by which way and at which cost they do.
#pragma once

#include "core/math/vec.h"
#include "renderer/base/hash.h"

namespace minkray::testing {

struct HashedBits {
  Hash answers, costs;

  template <class Number>
  static void add(Hash& hash, const Number& number) {
    hash.add({reinterpret_cast<const char*>(&number), sizeof number});
  }
  template <class T>
  static void add(Hash& hash, const Vec3<T>& v) {
    for (int k = 0; k < 3; ++k) add(hash, T(v[k]));
  }
};

}  // namespace minkray::testing
