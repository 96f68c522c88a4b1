// SPDX-License-Identifier: MIT
// Pairs of kinds that the solvers are compiled for.
#pragma once

#include "core/pair/core_pair.h"

namespace minkray {

/// Calls f.template operator()<A, B>() for the pair's kinds if both are known and A's is not after
/// B's in the enumeration; otherwise with `other` for both.
template <class F>
auto with_core_kinds(const CorePair& pair, F&& f) {
  return with_core_kind(pair.a.kind, [&]<CoreKind A>() {
    return with_core_kind(pair.b.kind, [&]<CoreKind B>() {
      if constexpr (A <= B && B != CoreKind::other)
        return f.template operator()<A, B>();
      else
        return f.template operator()<CoreKind::other, CoreKind::other>();
    });
  });
}

}  // namespace minkray
