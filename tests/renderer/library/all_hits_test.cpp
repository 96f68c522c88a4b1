// SPDX-License-Identifier: MIT
// All hits of rays and exits at meshes, through the public headers.
#include <gtest/gtest.h>

#include <minkray/minkray.h>
#include <algorithm>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "tests/renderer/library/errors.h"

namespace {

namespace mk = minkray;

/// A closed frame: a square ring around z, of whole numbers, from radius 2 to 3.
mk::Shape frame() {
  std::vector<mk::Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // Four points per corner: outer and inner, below and above.
  for (int corner = 0; corner < 4; ++corner)
    for (const double radius : {3.0, 2.0})
      for (const double z : {0.0, 1.0})
        vertices.push_back(
            {corner == 0 || corner == 3 ? radius : -radius, corner < 2 ? radius : -radius, z});
  const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  };
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t i = 4 * k, j = 4 * ((k + 1) % 4);
    face(i, j, j + 1, i + 1);          // outer
    face(i + 2, i + 3, j + 3, j + 2);  // inner
    face(i + 1, j + 1, j + 3, i + 3);  // above
    face(i, i + 2, j + 2, j);          // below
  }
  return mk::mesh(vertices, triangles);
}

std::vector<double> ts_of(mk::View<const mk::Crossing> hits) {
  std::vector<double> ts;
  for (const mk::Crossing& hit : hits) ts.push_back(hit.t);
  return ts;
}

TEST(LibraryAllHits, of_a_mesh_are_all_entries_and_exits) {
  const mk::Shape ring = frame();
  ASSERT_TRUE(mk::mesh_info(ring).is_closed());
  mk::Scene scene;
  const std::uint32_t object = scene.add(ring);
  const std::uint32_t ball = scene.add(mk::sphere(1), mk::translation({0, 0, 0.5}));
  scene.commit();
  const mk::AllHits found = scene.all_hits(mk::Ray{{-5, 0.25, 0.5}, {1, 0, 0}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.status(0), mk::hit);
  const double half = std::sqrt(1 - 0.0625);
  const std::vector<double> expected = {2, 3, 5 - half, 5 + half, 7, 8};
  ASSERT_EQ(found[0].size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const mk::Crossing& hit = found[0][i];
    EXPECT_NEAR(hit.t, expected[i], 1e-14);
    EXPECT_LE(hit.t_lo, expected[i] + 1e-15);
    EXPECT_GE(hit.t_hi, expected[i] - 1e-15);
    EXPECT_LE(hit.t_hi - hit.t_lo, 1e-13);
    EXPECT_EQ(hit.leaves, int(i % 2));
    EXPECT_EQ(hit.normal.x > 0, i % 2 == 1);
    EXPECT_EQ(hit.object, i == 2 || i == 3 ? ball : object);
    EXPECT_EQ(hit.part >= 0, hit.object == object);
    EXPECT_NEAR(hit.point.x, expected[i] - 5, 1e-14);
  }
  // Exactly through edges and vertices: along the diagonals of faces, through corners.
  for (const double y : {0.0, 2.0, 3.0, -2.0, -3.0, 2.5})
    for (const double z : {0.0, 0.5, 1.0}) {
      const auto hits = scene.all_hits(mk::Ray{{-5, y, z}, {1, 0, 0}});
      int of_ring = 0;
      for (const mk::Crossing& hit : hits[0])
        if (hit.object == object) {
          EXPECT_EQ(hit.leaves, of_ring++ % 2) << y << ' ' << z;
        }
      EXPECT_EQ(of_ring % 2, 0) << y << ' ' << z;
    }
  for (int x = -6; x <= 6; ++x)
    for (int y = -6; y <= 6; ++y) {
      const auto hits = scene.all_hits(mk::Ray{{0.5 * x, 0.5 * y, 9}, {0, 0, -1}});
      int leavings = 0, of_ring = 0;
      for (const mk::Crossing& hit : hits[0])
        if (hit.object == object) leavings += hit.leaves, ++of_ring;
      EXPECT_EQ(of_ring, 2 * leavings);
      const int reach = std::max(std::abs(x), std::abs(y));
      if (reach == 5) {
        EXPECT_EQ(of_ring, 2) << x << ' ' << y;
      }
      if (reach < 4) {
        EXPECT_EQ(of_ring, 0);
      }
    }
}

TEST(LibraryAllHits, of_a_ray_that_begins_or_ends_inside_are_fewer) {
  mk::Scene scene;
  scene.add(frame());
  scene.add(mk::box({1, 1, 1}));
  scene.add_half_space({0, 0, 1}, -4);
  scene.commit();
  EXPECT_EQ(ts_of(scene.all_hits(mk::Ray{{-2.5, 0, 0.5}, {1, 0, 0}})[0]),
            (std::vector<double>{0.5, 1.5, 3.5, 4.5, 5.5}));
  EXPECT_EQ(ts_of(scene.all_hits(mk::Ray{{-5, 0, 0.5}, {1, 0, 0}, 2.5})[0]),
            (std::vector<double>{2}));
  EXPECT_EQ(ts_of(scene.all_hits(mk::Ray{{-5, 0, 0.5}, {1, 0, 0}, 3})[0]),
            (std::vector<double>{2, 3}));
  // A t_max of 0 is no end, as for casts.
  EXPECT_EQ(scene.all_hits(mk::Ray{{-5, 0, 0.5}, {1, 0, 0}, 0})[0].size(), 6u);
  const auto up = scene.all_hits(mk::Ray{{0, 0, -6}, {0, 0, 2}});
  EXPECT_EQ(ts_of(up[0]), (std::vector<double>{1, 2.5, 3.5}));
  EXPECT_EQ(up[0][0].leaves, 1);
  EXPECT_EQ(up[0][0].normal.z, 1);
  const auto down = scene.all_hits(mk::Ray{{9, 0, 6}, {0, 0, -2}});
  EXPECT_EQ(ts_of(down[0]), (std::vector<double>{5}));
  EXPECT_EQ(down[0][0].leaves, 0);
  EXPECT_EQ(scene.all_hits(mk::Ray{{0, 0, 9}, {1, 0, 0}}).status(0), mk::miss);
  EXPECT_EQ(scene.all_hits(mk::View<const mk::Ray>()).size(), 0u);
}

TEST(LibraryAllHits, have_the_same_bits_for_any_number_of_threads) {
  mk::Scene scene;
  for (int i = 0; i < 30; ++i)
    scene.add(
        i % 2 == 0 ? frame() : mk::rounded(mk::box({1, 0.5, 0.5}), 0.25),
        mk::pose({2.0 * (i % 5) - 4, 1.5 * (i / 5) - 4, 0.3 * i - 4}, {0.1 * i, 0.2, 0.3, 1}));
  scene.commit();
  std::vector<mk::Ray> rays;
  for (int i = 0; i < 9000; ++i)
    rays.push_back({{-9, std::sin(1.0 * i), std::cos(1.3 * i)},
                    {1, 0.5 * std::sin(0.7 * i), 0.5 * std::cos(0.9 * i)}});
  mk::Options one, four;
  one.threads = 1;
  four.threads = 4;
  const mk::AllHits a = scene.all_hits(rays, one), b = scene.all_hits(rays, four);
  ASSERT_EQ(a.hits().size(), b.hits().size());
  EXPECT_GT(a.hits().size(), 20000u);
  EXPECT_EQ(std::memcmp(a.hits().data(), b.hits().data(), a.hits().size() * sizeof(mk::Crossing)),
            0);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(a[i].size(), b[i].size());
    const mk::AllHits alone = scene.all_hits(rays[i]);
    ASSERT_EQ(ts_of(alone[0]), ts_of(a[i]));
    const mk::Hit first = scene.cast(rays[i]);
    ASSERT_EQ(first.found(), a[i].size() > 0);
    if (first.found()) {
      ASSERT_EQ(first.t, a[i][0].t);
    }
  }
}

TEST(LibraryAllHits, an_error_names_the_ray) {
  mk::Scene scene;
  scene.add(mk::sphere(1));
  scene.commit();
  EXPECT_EQ(error_of([&] {
              (void)scene.all_hits(mk::Ray{{0, 0, 0}, {0, 0, 0}});
            }),
            "minkray_scene_all_hits: rays[0].direction: must not be zero (got [0, 0, 0])");
}

TEST(LibraryExit, of_a_mesh_is_the_last_one) {
  mk::Scene scene;
  const std::uint32_t object = scene.add(frame());
  const std::uint32_t ball = scene.add(mk::sphere(1));
  scene.commit();
  const mk::Ray through{{-5, 0.25, 0.5}, {1, 0, 0}};
  const mk::Hit exit = scene.exit(object, through);
  EXPECT_EQ(exit.status, mk::hit);
  EXPECT_EQ(exit.t, 8);
  EXPECT_LE(exit.t_lo, 8);
  EXPECT_GE(exit.t_hi, 8);
  EXPECT_EQ(exit.object, object);
  EXPECT_GE(exit.part, 0);
  EXPECT_EQ(exit.normal.x, 1);
  // Within the hole: the first side was left.
  EXPECT_EQ(scene.exit(object, {through.origin, through.direction, 5}).t, 3);
  const mk::Hit inside = scene.exit(object, {through.origin, through.direction, 7.5});
  EXPECT_EQ(inside.status, mk::inside);
  EXPECT_EQ(inside.t, 7.5);
  EXPECT_EQ(scene.exit(object, {through.origin, through.direction, 1}).status, mk::miss);
  EXPECT_EQ(scene.exit(object, {{0, 0, 9}, {0, 0, -1}}).status, mk::miss);
  EXPECT_EQ(scene.exit(object, {{-2.5, 0, 0.5}, {0, 0, 1}}).t, 0.5);
  // At an edge, and at a corner.
  EXPECT_EQ(scene.exit(object, {{-5, -5, 0.5}, {1, 1, 0}}).t, 8);
  EXPECT_EQ(scene.exit(object, {{-6, -6, 2}, {1, 1, -0.25}}).t, 8);
  const mk::Hit of_ball = scene.exit(ball, {{-5, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(of_ball.t, 6);
  EXPECT_LE(of_ball.t_lo, 6);
  EXPECT_GT(of_ball.t_lo, 6 - 1e-12);
}

TEST(LibraryPairs, memories_of_meshes_only_change_the_work) {
  const mk::Shape a = frame(), b = frame();
  mk::PairMemory memory;
  for (int i = 0; i < 200; ++i) {
    const mk::Pose at = mk::pose({6.5 + std::sin(0.05 * i), 0.01 * i, 0.3}, {0, 0.01 * i, 0.02, 1});
    const mk::Distance cold = mk::signed_distance(a, mk::identity(), b, at);
    const mk::Distance warm = mk::signed_distance(a, mk::identity(), b, at, memory);
    ASSERT_EQ(warm.status, cold.status);
    ASSERT_NEAR(warm.value, cold.value, 1e-13);
    ASSERT_LE(warm.lower, cold.upper);
    ASSERT_GE(warm.upper, cold.lower);
    ASSERT_TRUE(std::ranges::any_of(memory.words, [](std::uint64_t word) { return word != 0; }));
  }
  // Accepts any contents: the memory of another pair, or of a shape.
  const mk::Distance other =
      mk::signed_distance(mk::sphere(1), mk::identity(), b, mk::translation({6, 0, 0}), memory);
  EXPECT_NEAR(other.value, 2, 1e-13);
  EXPECT_NEAR(
      mk::signed_distance(mk::sphere(1), mk::identity(), b, mk::translation({6, 0, 0}), memory)
          .value,
      2, 1e-13);
}

}  // namespace
