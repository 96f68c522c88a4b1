// SPDX-License-Identifier: MIT
// Finds equal shapes, so that they can share what is derived from them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/shape/shape.h"

namespace minkray {

/// The kinds and the bits of all numbers of a shape, in order: equal keys are equal shapes.
/// Functions of programs are equal if they are the same object.
std::vector<std::uint64_t> key_of(const Shape& shape);

/// FNV-1a over the words.
std::size_t hash_of(const std::vector<std::uint64_t>& key);

}  // namespace minkray
