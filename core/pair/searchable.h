// SPDX-License-Identifier: MIT
// Range of body sizes for which searches and closed forms of pairs are reliable.
#pragma once

namespace minkray {

/// Limits of lengths. Between them, sixth powers of lengths (such as squares of triple products)
/// are normal numbers: they neither overflow nor lose digits.
inline constexpr double largest_length = 0x1p160;
inline constexpr double smallest_length = 1 / largest_length;

/// True if all products of a pair's lengths are normal numbers or 0. Pairs that are far apart may
/// be small, since they need no products of small lengths.
inline bool are_searchable(double size, double distance) {
  const double length = size + distance;
  return size < largest_length && (length > smallest_length || length == 0);
}

}  // namespace minkray
