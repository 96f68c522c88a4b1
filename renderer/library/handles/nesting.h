// SPDX-License-Identifier: MIT
// Limits the size of composite shapes. Files are finite, but handles can nest: a sum of a shape
// with itself, repeated forty times, has a million million parts.
#pragma once

#include <cstddef>

#include "core/shape/shape.h"

namespace minkray {

/// Largest depth of shapes within shapes: far below the capacity of the stack.
inline constexpr std::size_t deepest_shape = 1000;

/// Largest number of shapes within one, each counted as often as it occurs: a support point needs
/// one of each.
inline constexpr std::size_t most_shapes_in_one = std::size_t{1} << 20;

/// Throws CallError if the shape is larger.
void check_nesting(const Shape& shape);

}  // namespace minkray
