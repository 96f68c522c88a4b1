// SPDX-License-Identifier: MIT
// Selects the code that is compiled for a pair of kinds of cores.
#pragma once

#include "core/pair/core_pair.h"

namespace minkray {

/// Calls f.template operator()<A, B>() for the kinds A and B of the pair's cores, if neither is
/// `other` and A is not after B in the enumeration; otherwise calls it with `other` for both.
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
