// SPDX-License-Identifier: MIT
// Sorts keys by their positions (places) on a space-filling curve, with several threads.
#pragma once

#include <cstdint>

#include "core/parallel/first_touch.h"

namespace minkray {

/// A place in the upper 32 bits, an index in the lower 32 bits.
using KeyedPlace = std::uint64_t;

/// Sorts by the lowest `bits` bits of the places. The sort is stable: the result does not depend on
/// the number of threads.
void sort_by_place(FirstTouchVector<KeyedPlace>& keys, int bits);

}  // namespace minkray
