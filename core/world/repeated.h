// SPDX-License-Identifier: MIT
// Instances that occur several times in one place: rays need only find two of them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/instances.h"

namespace minkray {

/// The instances that no ray meets first, in ascending order: two others of less index have the
/// same shape, place and ray kinds, and a ray leaves out one instance at most. None if any
/// instance moves.
std::vector<std::uint32_t> repeated_instances(const Instances& instances);

}  // namespace minkray
