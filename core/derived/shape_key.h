// SPDX-License-Identifier: MIT
// Finds equal shapes, so that they can share data computed from them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/shape/shape.h"

namespace minkray {

/// Returns the kinds and the bits of all numbers of a shape, in order. Shapes with equal keys are
/// equal. The key of a custom shape contains the address of its SupportSource.
std::vector<std::uint64_t> key_of(const Shape& shape);

/// FNV-1a hash of a key.
std::size_t hash_of(const std::vector<std::uint64_t>& key);

}  // namespace minkray
