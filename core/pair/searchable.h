// SPDX-License-Identifier: MIT
// The sizes of bodies at which searches and closed forms of pairs may be trusted.
#pragma once

namespace minkray {

/// Sixth powers of lengths between these are normal numbers, such as squares of triple products.
inline constexpr double largest_length = 0x1p160;
inline constexpr double smallest_length = 1 / largest_length;

/// True if products of a pair's lengths are normal numbers or 0. Bodies far apart need none of
/// small lengths.
inline bool are_searchable(double size, double distance) {
  const double length = size + distance;
  return size < largest_length && (length > smallest_length || length == 0);
}

}  // namespace minkray
