// SPDX-License-Identifier: MIT
#include "core/math/gather_rows.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace minkray::testing {
namespace {

constexpr int lanes = IsaHere::register_bytes / 8;

void expect_rows(const std::array<std::size_t, std::size_t(lanes)>& chosen) {
  using W = Wide<double, lanes, IsaHere>;
  constexpr std::size_t row_size = 9, first = 1, count = 8;
  std::vector<double> table(row_size * 20);
  std::iota(table.begin(), table.end(), 0.0);
  W index;
  for (int lane = 0; lane < lanes; ++lane)
    index.set_lane(lane, static_cast<double>(chosen[static_cast<std::size_t>(lane)]));
  const std::array<W, count> columns = gather_row<count>(index, table.data() + first, row_size);
  for (int lane = 0; lane < lanes; ++lane) {
    const std::size_t row = chosen[static_cast<std::size_t>(lane)];
    const std::array<double, count> alone =
        gather_row<count>(static_cast<double>(row), table.data() + first, row_size);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_EQ(alone[k], table[row * row_size + first + k]);
      EXPECT_EQ(columns[k].lane(lane), alone[k]) << "lane " << lane << ", column " << k;
    }
  }
}

TEST(GatherRows, every_lane_reads_its_row) {
  expect_rows({3, 18});
}

TEST(GatherRows, or_all_the_same) {
  expect_rows({0, 0});
}

}  // namespace
}  // namespace minkray::testing
