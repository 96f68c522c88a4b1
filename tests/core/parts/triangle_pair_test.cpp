// SPDX-License-Identifier: MIT
#include "core/parts/triangle_pair.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/bvh/traverse.h"
#include "core/mesh/exact_sign.h"
#include "core/pair/triangle_part.h"
#include "core/pair_distance/signed_distance.h"
#include "core/parts/nearest_features.h"
#include "core/parts/triangle_lanes.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

/// Random, slivers, on a lattice (so that edges are parallel or touch), or without area.
TriangleCorners random_triangle(testing::Random& random, int kind) {
  TriangleCorners triangle;
  for (Vec3<double>& corner : triangle) corner = random.in_cube();
  if (kind == 1)
    triangle[2] = triangle[0] + 0.4 * (triangle[1] - triangle[0]) + 1e-7 * random.in_cube();
  if (kind == 2)
    for (Vec3<double>& corner : triangle) corner = (2 * corner).array().round();
  if (kind == 3) triangle[2] = triangle[1];
  return triangle;
}

TriangleCorners moved(TriangleCorners triangle, const Vec3<double>& way) {
  for (Vec3<double>& corner : triangle) corner += way;
  return triangle;
}

SignedDistance by_search(const TriangleCorners& a, const TriangleCorners& b) {
  return signed_distance(TrianglePart(a[0], a[1], a[2]).shape(),
                         TrianglePart(b[0], b[1], b[2]).shape());
}

TEST(TrianglePair, gaps_are_what_a_search_finds) {
  testing::Random random(1);
  int apart = 0, settled = 0;
  for (int i = 0; i < testing::number_of_cases(20000); ++i) {
    const TriangleCorners a = random_triangle(random, i % 4),
                          b = moved(random_triangle(random, i / 4 % 4), 2 * random.in_cube());
    const TriangleGap gap = triangle_gap(a, b);
    const SignedDistance found = by_search(a, b);
    ASSERT_LE(gap.lower, found.upper + 1e-14);
    ASSERT_GE(gap.upper, found.lower - 1e-14);
    if (!(found.lower > 1e-9)) continue;
    ++apart;
    ASSERT_NEAR((gap.point_b - gap.point_a).norm(), gap.upper, 1e-14);
    const bool is_settled = gap.upper - gap.lower < 1e-12;
    settled += is_settled ? 1 : 0;
    ASSERT_TRUE(!is_settled || std::abs(gap.upper - found.value) < 1e-11);
  }
  EXPECT_GT(apart, testing::number_of_cases(20000) / 2);
  EXPECT_GT(settled, apart * 99 / 100);
}

/// True if an edge of one passes through the other, by exact signs.
bool cross_exactly(const TriangleCorners& a, const TriangleCorners& b) {
  const auto passes = [](const TriangleCorners& edges, const TriangleCorners& face) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3<double>&p = edges[i], &q = edges[(i + 1) % 3];
      const int of_p = exact_side_of_plane(face[0], face[1], face[2], p),
                of_q = exact_side_of_plane(face[0], face[1], face[2], q);
      if (of_p * of_q >= 0) continue;
      int sides[3];
      for (std::size_t k = 0; k < 3; ++k)
        sides[k] = exact_side_of_plane(p, q, face[k], face[(k + 1) % 3]);
      if (sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2]) return true;
    }
    return false;
  };
  return passes(a, b) || passes(b, a);
}

TEST(TrianglePair, those_that_surely_cross_do_so_with_moved_corners) {
  testing::Random random(2);
  int sure = 0, crossing = 0;
  for (int i = 0; i < testing::number_of_cases(20000); ++i) {
    TriangleCorners a = random_triangle(random, i % 3),
                    b = moved(random_triangle(random, i / 3 % 3), 0.5 * random.in_cube());
    const double loss = i % 2 == 0 ? 1e-15 : 1e-3;
    Vec3<double> common;
    crossing += cross_exactly(a, b) ? 1 : 0;
    if (!surely_cross(a, b, loss, common)) continue;
    ++sure;
    // Below the loss by what the sum is rounded to.
    for (TriangleCorners* triangle : {&a, &b})
      for (Vec3<double>& corner : *triangle) {
        corner += 0.57 * loss * random.in_cube();
      }
    ASSERT_TRUE(cross_exactly(a, b));
    const auto distance_to = [&](const TriangleCorners& of) {
      return triangle_gap({common, common, common}, of).lower;
    };
    // The point is on both as they were, and each corner has moved by the loss at most.
    const double far = loss + 1e-14;
    ASSERT_LE(distance_to(a), far);
    ASSERT_LE(distance_to(b), far);
  }
  EXPECT_GT(sure, crossing / 3);
}

TEST(TrianglePair, without_area_or_of_extreme_size_nothing_false_is_said) {
  const TriangleCorners point = {Vec3<double>(0, 0, 0), Vec3<double>(0, 0, 0),
                                 Vec3<double>(0, 0, 0)};
  const TriangleCorners other = {Vec3<double>(2, 0, 0), Vec3<double>(2, 1, 0),
                                 Vec3<double>(2, 0, 1)};
  const TriangleGap gap = triangle_gap(point, other);
  EXPECT_DOUBLE_EQ(gap.lower, 2);
  EXPECT_DOUBLE_EQ(gap.upper, 2);
  for (const double scale : {1e-200, 1e-160, 1e-100, 1e100, 1e160, 1e200}) {
    TriangleCorners a = other, b = moved(other, {1, 0, 0});
    for (TriangleCorners* triangle : {&a, &b})
      for (Vec3<double>& corner : *triangle) corner *= scale;
    const TriangleGap scaled = triangle_gap(a, b);
    EXPECT_LE(scaled.lower, scale * (1 + 1e-14)) << scale;
    EXPECT_GE(scaled.upper, scale * (1 - 1e-14)) << scale;
    Vec3<double> common;
    EXPECT_FALSE(surely_cross(a, b, 1e-15 * scale, common)) << scale;
  }
}

TEST(TrianglePair, instruction_sets_have_the_same_bits) {
  if (!has_avx2()) GTEST_SKIP() << "no AVX2 here";
  testing::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const TriangleCorners a = random_triangle(random, i % 4),
                          b = moved(random_triangle(random, i / 4 % 4), random.in_cube());
    NearestPoints wide, narrow;
    nearest_features_avx2(a, b, wide);
    nearest_features_sse2(a, b, narrow);
    ASSERT_EQ(std::memcmp(&wide, &narrow, sizeof wide), 0);
    EightTriangles eight;
    eight.count = 5;
    for (int k = 0; k < eight.count; ++k)
      eight.set(k, 0, moved(random_triangle(random, k % 4), random.in_cube()));
    eight.finish();
    EightTriangles other = eight;
    triangle_normals_sse2(other);
    triangle_normals_avx2(eight);
    ASSERT_EQ(std::memcmp(&eight.normals, &other.normals, sizeof eight.normals), 0);
    const Vec3<double> known = random.direction();
    double of_wide[8], of_narrow[8];
    triangle_gaps_avx2(a, eight.normal(0), eight, &known, of_wide);
    triangle_gaps_sse2(a, eight.normal(0), eight, &known, of_narrow);
    ASSERT_EQ(std::memcmp(of_wide, of_narrow, sizeof of_wide), 0);
  }
}

TEST(TriangleLanes, gaps_are_lower_bounds_and_near) {
  testing::Random random(4);
  double sum = 0, of_exact = 0;
  for (int i = 0; i < testing::number_of_cases(4000); ++i) {
    const TriangleCorners a = random_triangle(random, i % 3);
    EightTriangles own, eight;
    own.count = 1;
    own.set(0, 0, a);
    own.finish();
    eight.count = 8;
    for (int k = 0; k < 8; ++k)
      eight.set(k, 0, moved(random_triangle(random, k % 4), 3 * random.in_cube()));
    eight.finish();
    const Vec3<double> known = random.direction();
    double gaps[8];
    triangle_gaps(a, own.normal(0), eight, i % 2 == 0 ? &known : nullptr, gaps);
    for (int k = 0; k < 8; ++k) {
      const double exact = std::max(0.0, by_search(a, eight.triangle(k)).upper);
      ASSERT_LE(gaps[k], exact + 1e-14);
      sum += std::max(0.0, gaps[k]);
      of_exact += exact;
    }
  }
  EXPECT_GT(sum, 0.9 * of_exact);
}

}  // namespace
}  // namespace minkray
