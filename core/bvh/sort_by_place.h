// SPDX-License-Identifier: MIT
// Sorting keys by their places on a curve, on several threads.
#pragma once

#include <cstdint>

#include "core/parallel/first_touch.h"

namespace minkray {

/// A place in the upper half, an index in the lower one.
using KeyedPlace = std::uint64_t;

/// Sorts by the lowest `bits` of the upper halves, and is stable: the same for any number of
/// threads.
void sort_by_place(FirstTouchVector<KeyedPlace>& keys, int bits);

}  // namespace minkray
