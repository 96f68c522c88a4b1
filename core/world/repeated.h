// SPDX-License-Identifier: MIT
// Finds instances that occur several times at one place: rays only need two of them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/instances.h"

namespace minkray {

/// An instance, and one of lower index with the same shape, place and ray kinds.
struct RepeatedInstance {
  std::uint32_t number, same_as;
};

/// Returns the instances that no ray can hit first, in ascending order: two others with lower
/// indices are the same, and a ray skips one instance at most. Empty if any instance moves.
std::vector<RepeatedInstance> repeated_instances(const Instances& instances);

}  // namespace minkray
