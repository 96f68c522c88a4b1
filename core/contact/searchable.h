// SPDX-License-Identifier: MIT
// The sizes of bodies at which searches and closed forms of pairs may be trusted.
#pragma once

namespace minkray {

/// Sixth powers of lengths between these are normal numbers, such as squares of triple products.
inline constexpr double largest_length = 0x1p160;
inline constexpr double smallest_length = 1 / largest_length;

/// Whether products of a pair's lengths are numbers. Bodies far apart need none of small ones.
inline bool are_searchable(double size, double distance) {
  return size < largest_length && size + distance > smallest_length;
}

}  // namespace minkray
