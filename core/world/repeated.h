// SPDX-License-Identifier: MIT
// Finds instances that have the same shape and pose as others. Rays need only two of such copies,
// since a ray skips at most one instance.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/instances.h"

namespace minkray {

/// An instance, and one of lower index with the same shape, pose and ray kinds.
struct RepeatedInstance {
  std::uint32_t number, same_as;
};

/// Returns the instances that no ray can hit first, in ascending order. For each of them, two
/// instances with lower indices have the same shape, pose and ray kinds, and a ray skips at most
/// one instance. Empty if any instance moves.
std::vector<RepeatedInstance> repeated_instances(const Instances& instances);

}  // namespace minkray
