// SPDX-License-Identifier: MIT
// Distance of two cores by GJK with sliding features (curved_gjk.h). Compiled separately for each
// pair of kinds, so that the compiler can inline support points, which dominate the cost.
#pragma once

#include <array>

#include "core/pair/core_pair.h"

namespace minkray {

/// Four points c of C = B - A (core_pair.h) that enclose the origin, if found, and the
/// corresponding points a of A. The search for the depth (expanding_polytope.h) can start from
/// these points.
struct Enclosure {
  std::array<Vec3<double>, 4> c, a;
  bool is_found = false;
};

/// Returns the distance of two cores. Fastest if A's kind is not after B's in CoreKind. If
/// `enclosure` is not null, writes four points there that enclose the origin, if any were found.
CoreDistance distance_of_cores(const CorePair& pair, const CoreSearch& search,
                               Enclosure* enclosure = nullptr);

}  // namespace minkray
