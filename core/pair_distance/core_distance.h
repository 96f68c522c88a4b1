// SPDX-License-Identifier: MIT
// The distance of two cores by GJK of sliding features (curved_gjk.h), compiled for the kinds of
// each pair: support points are most of the work, and the compiler sees through them.
#pragma once

#include <array>

#include "core/pair/core_pair.h"

namespace minkray {

/// Four points of B - A around the origin, if there are any: where a polytope may begin.
struct Enclosure {
  std::array<Vec3<double>, 4> c, a;
  bool is_found = false;
};

/// Fastest if A's kind is not after B's.
CoreDistance distance_of_cores(const CorePair& pair, const CoreSearch& search,
                               Enclosure* enclosure = nullptr);

}  // namespace minkray
