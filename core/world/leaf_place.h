// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace minkray {

/// What casts read of an instance, in the order of the hierarchy's leaves: neighbours are near.
template <class T>
struct LeafPlace {
  T centre[3], to_inner[9];  ///< column by column
  std::uint32_t definition, instance;
};

}  // namespace minkray
