// SPDX-License-Identifier: MIT
// Finds instances that occur several times at one place: rays only need two of them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/instances.h"

namespace minkray {

/// Returns the instances that no ray can hit first, in ascending order: two others with lower
/// indices have the same shape, place and ray kinds, and a ray skips one instance at most. Empty if
/// any instance moves.
std::vector<std::uint32_t> repeated_instances(const Instances& instances);

}  // namespace minkray
