// SPDX-License-Identifier: MIT
// Tiles go along a curve: each once, neighbours after neighbours, and any run of them is a patch.
#include "renderer/film/tile_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace minkray {
namespace {

TEST(TileOrder, each_tile_comes_once) {
  for (const auto& [columns, rows] :
       {std::pair{1, 1}, {1, 9}, {7, 1}, {3, 5}, {30, 17}, {64, 64}, {120, 68}}) {
    std::vector<std::uint32_t> order =
        along_curve(static_cast<std::size_t>(columns), static_cast<std::size_t>(rows));
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> all(order.size());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(order.size(), static_cast<std::size_t>(columns * rows));
    EXPECT_EQ(order, all);
  }
  EXPECT_TRUE(along_curve(0, 0).empty());
}

TEST(TileOrder, in_a_square_the_next_tile_is_a_neighbour) {
  for (const std::uint32_t side : {2u, 8u, 64u}) {
    const auto order = along_curve(side, side);
    for (std::size_t i = 1; i < order.size(); ++i) {
      const auto distance = [&](auto of) {
        return std::abs(static_cast<int>(of(order[i])) - static_cast<int>(of(order[i - 1])));
      };
      EXPECT_EQ(distance([&](std::uint32_t tile) { return tile % side; }) +
                    distance([&](std::uint32_t tile) { return tile / side; }),
                1);
    }
  }
}

// In rows 64 tiles of a picture 120 wide are a strip of 64 by 1.
TEST(TileOrder, a_run_of_tiles_is_a_patch) {
  const std::uint32_t columns = 120, rows = 68, run = 64;
  const auto order = along_curve(columns, rows);
  for (std::size_t begin = 0; begin + run <= order.size(); begin += run) {
    std::vector<std::uint32_t> x, y;
    for (std::size_t i = begin; i < begin + run; ++i) {
      x.push_back(order[i] % columns);
      y.push_back(order[i] / columns);
    }
    const auto extent = [](const std::vector<std::uint32_t>& at) {
      const auto [least, most] = std::minmax_element(at.begin(), at.end());
      return *most - *least;
    };
    EXPECT_LE(std::max(extent(x), extent(y)), 48u) << begin;
  }
}

}  // namespace
}  // namespace minkray
