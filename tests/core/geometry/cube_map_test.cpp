// SPDX-License-Identifier: MIT
#include "core/geometry/cube_map.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace minkray::testing {
namespace {

TEST(CubeMap, a_direction_lies_in_its_cell) {
  Random random(61);
  for (const double about : {0.0, 1.0, 7.0, 600.0, 1e5}) {
    const CubeMap map(about);
    EXPECT_GE(static_cast<double>(map.cells()), about);
    for (int i = 0; i < 500; ++i) {
      const Vec3<double> n = random.direction() * std::pow(10.0, i % 40 - 20);
      const auto found = static_cast<std::size_t>(map.cell_of(n));
      ASSERT_LT(found, map.cells());
      const CubeMap::Cell cell = map[found];
      const double largest = n.cwiseAbs().maxCoeff();
      EXPECT_EQ(n[cell.axis] * cell.sign, largest);
      const double u = n[(cell.axis + 1) % 3] / largest, v = n[(cell.axis + 2) % 3] / largest;
      EXPECT_GE(u, cell.u - 1e-15);
      EXPECT_LE(u, cell.u + cell.width + 1e-15);
      EXPECT_GE(v, cell.v - 1e-15);
      EXPECT_LE(v, cell.v + cell.width + 1e-15);
    }
  }
}

TEST(CubeMap, every_cell_is_found_by_its_middle) {
  const CubeMap map(500);
  for (std::size_t i = 0; i < map.cells(); ++i) {
    const CubeMap::Cell cell = map[i];
    Vec3<double> n;
    n[cell.axis] = cell.sign;
    n[(cell.axis + 1) % 3] = cell.u + cell.width / 2;
    n[(cell.axis + 2) % 3] = cell.v + cell.width / 2;
    EXPECT_EQ(map.cell_of(n), static_cast<double>(i));
    EXPECT_EQ(map.cell_of(Vec3<float>(n.cast<float>())), static_cast<float>(i));
  }
}

TEST(CubeMap, what_is_no_direction_gets_some_cell) {
  const CubeMap map(500);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Vec3<double>& n : {Vec3<double>(0, 0, 0), Vec3<double>(nan, 1, 0),
                                Vec3<double>(nan, nan, nan), Vec3<double>(infinity, 1, -infinity)})
    EXPECT_LT(static_cast<std::size_t>(map.cell_of(n)), map.cells());
}

TEST(CubeMap, has_no_more_cells_than_a_float_can_count) {
  const CubeMap map(1e12);
  EXPECT_LE(map.cells(), std::size_t(1) << 24);
  EXPECT_LT(static_cast<std::size_t>(map.cell_of(Vec3<float>(1, 1, -1))), map.cells());
}

}  // namespace
}  // namespace minkray::testing
