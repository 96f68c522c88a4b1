// SPDX-License-Identifier: MIT
#include "renderer/film/tile_order.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace minkray {
namespace {

/// Position of a place along the curve through a square of `side` (a power of two).
std::uint64_t place_on_curve(std::uint64_t side, std::uint64_t x, std::uint64_t y) {
  std::uint64_t place = 0;
  for (std::uint64_t half = side / 2; half > 0; half /= 2) {
    const bool right = (x & half) != 0, below = (y & half) != 0;
    place += half * half * ((right ? 3u : 0u) ^ (below ? 1u : 0u));
    // Quarters are turned so that the curve continues where the one before ends.
    if (!below) {
      if (right) {
        x = side - 1 - x;
        y = side - 1 - y;
      }
      std::swap(x, y);
    }
  }
  return place;
}

}  // namespace

std::vector<std::uint32_t> along_curve(std::size_t columns, std::size_t rows) {
  const std::uint64_t side = std::bit_ceil(std::uint64_t{std::max(columns, rows)});
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  keyed.reserve(columns * rows);
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x)
      keyed.emplace_back(place_on_curve(side, x, y), static_cast<std::uint32_t>(y * columns + x));
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order;
  order.reserve(keyed.size());
  for (const auto& [place, tile] : keyed) order.push_back(tile);
  return order;
}

}  // namespace minkray
