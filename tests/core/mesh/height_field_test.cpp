// SPDX-License-Identifier: MIT
// Terrains: where rays from above meet them, and how they are closed.
#include "core/mesh/height_field.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/mesh/mesh_ray.h"
#include "tests/support/messages.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

TEST(HeightField, rays_from_above_meet_the_triangle_of_their_cell) {
  testing::Random random(61);
  constexpr std::size_t rows = 7, columns = 5;
  constexpr double size_x = 2, size_y = 3;
  std::vector<double> heights;
  for (std::size_t i = 0; i < rows * columns; ++i) heights.push_back(random.uniform(-1, 1));
  const auto mesh = mesh_of({heights, rows, columns, size_x, size_y, {}});
  EXPECT_EQ(mesh->size(), 2 * (rows - 1) * (columns - 1));
  EXPECT_FALSE(mesh->is_closed());
  const auto at = [&](std::size_t r, std::size_t c) { return heights[r * columns + c]; };
  for (int i = 0; i < 2000; ++i) {
    const double u = random.uniform(0, columns - 1), v = random.uniform(0, rows - 1);
    const auto c = static_cast<std::size_t>(u), r = static_cast<std::size_t>(v);
    const double x = u - static_cast<double>(c), y = v - static_cast<double>(r);
    // The cell is cut from its least corner to its greatest one.
    const double height =
        y <= x ? at(r, c) + x * (at(r, c + 1) - at(r, c)) + y * (at(r + 1, c + 1) - at(r, c + 1))
               : at(r, c) + y * (at(r + 1, c) - at(r, c)) + x * (at(r + 1, c + 1) - at(r + 1, c));
    const Ray<double> ray{{size_x * (u / (columns - 1) - 0.5), size_y * (v / (rows - 1) - 0.5), 5},
                          {0, 0, -1}};
    PartCounts counts;
    const PartHit hit = closest_part(*mesh, ray, 0, counts);
    ASSERT_TRUE(hit.found());
    ASSERT_NEAR(hit.t, 5 - height, 1e-13);
    ASSERT_FALSE(hit.is_back);
    ASSERT_EQ(hit.part / 2, r * (columns - 1) + c);
  }
}

TEST(HeightField, a_bottom_closes_it) {
  const double heights[] = {0, 0.5, 0, 0, 2, 0, 1, 0, 0, 0, 0, 3};
  const auto mesh = mesh_of({heights, 3, 4, 1, 2, -0.5});
  const MeshFaults faults = mesh->faults();
  EXPECT_TRUE(faults.is_closed());
  EXPECT_EQ(faults.without_area, 0u);
  EXPECT_EQ(faults.repeated, 0u);
  EXPECT_TRUE(is_within(*mesh, {0.1, 0.1, -0.4}));
  EXPECT_FALSE(is_within(*mesh, {0.1, 0.1, -0.6}));
  EXPECT_EQ(mesh->bounds().lower, Vec3<double>(-0.5, -1, -0.5));
  EXPECT_EQ(mesh->bounds().upper, Vec3<double>(0.5, 1, 3));
  // From each side a ray comes in at a front.
  for (const Vec3<double>& d : {Vec3<double>(1, 0, 0), Vec3<double>(-1, 0, 0),
                                Vec3<double>(0, 1, 0), Vec3<double>(0, 0, 1)}) {
    PartCounts counts;
    const PartHit hit = closest_part(*mesh, {Vec3<double>(0.01, 0.02, -0.3) - 9 * d, d}, 0, counts);
    ASSERT_TRUE(hit.found());
    EXPECT_FALSE(hit.is_back);
  }
}

TEST(HeightField, what_is_wrong_is_told) {
  const double heights[] = {0, 1, 2, 3};
  const auto wrong = [&](const HeightField& field) -> std::string {
    return message_of<std::invalid_argument>([&] { mesh_of(field); });
  };
  EXPECT_EQ(wrong({heights, 2, 2, 1, 1, {}}), "");
  expect_messages<HeightField>(wrong, {{{heights, 1, 4, 1, 1, {}}, "two rows and two columns"},
                                       {{heights, 2, 3, 1, 1, {}}, "6 (got 4)"},
                                       {{heights, 2, 2, 0, 1, {}}, "size along x"},
                                       {{heights, 2, 2, 1, -1, {}}, "size along y"},
                                       {{heights, 2, 2, 1, 1, 0.0}, "bottom: must be"}});
  const double bad[] = {0, 1, 2, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_TRUE(has(wrong({bad, 2, 2, 1, 1, {}}), "heights[1][1]"));
}

}  // namespace
}  // namespace minkray
