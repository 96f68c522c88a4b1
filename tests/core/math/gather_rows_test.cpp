// SPDX-License-Identifier: MIT
#include "core/math/gather_rows.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace minkray::testing {
namespace {

template <class T, int N>
void expect_rows(const std::array<std::size_t, std::size_t(N)>& chosen) {
  using W = Wide<T, N, IsaHere>;
  constexpr std::size_t row_size = 9, first = 1, count = 8;
  std::vector<T> table(row_size * 20);
  std::iota(table.begin(), table.end(), T(0));
  W index;
  for (int lane = 0; lane < N; ++lane)
    index.set_lane(lane, static_cast<T>(chosen[static_cast<std::size_t>(lane)]));
  const std::array<W, count> columns = gather_row<count>(index, table.data() + first, row_size);
  for (int lane = 0; lane < N; ++lane) {
    const std::size_t row = chosen[static_cast<std::size_t>(lane)];
    const std::array<T, count> alone =
        gather_row<count>(static_cast<T>(row), table.data() + first, row_size);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_EQ(alone[k], table[row * row_size + first + k]);
      EXPECT_EQ(columns[k].lane(lane), alone[k]) << "lane " << lane << ", column " << k;
    }
  }
}

TEST(GatherRows, every_lane_reads_its_row) {
  expect_rows<float, IsaHere::register_bytes / 4>({7, 0, 19, 7});
  expect_rows<double, IsaHere::register_bytes / 8>({3, 18});
}

TEST(GatherRows, or_all_the_same) {
  expect_rows<float, IsaHere::register_bytes / 4>({5, 5, 5, 5});
  expect_rows<double, IsaHere::register_bytes / 8>({0, 0});
}

}  // namespace
}  // namespace minkray::testing
