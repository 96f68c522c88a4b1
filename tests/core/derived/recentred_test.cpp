// SPDX-License-Identifier: MIT
// Shapes far from their own origin, and the same moved to it: the same points, but for rounding of
// the shape's own size, and none left out there.
#include "core/derived/recentred.h"

#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/derived/shape_bounds.h"
#include "renderer/paper/solvers.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

using S = Shape;

S recentred_at(S shape, const Vec3<double>& by, const Mat3<double>& linear) {
  return Transform{std::move(shape), Affine<double>{linear, by}};
}

Vec3<long double> furthest(const S& shape, const Vec3<double>& n) {
  return shape.support(Vec3<long double>(n.cast<long double>()));
}

/// Moves the shape, which lies 1 away, and checks the result.
void expect_same_points(const S& shape, double size) {
  const std::optional<Recentred> nearer = recentred(shape);
  ASSERT_TRUE(nearer);
  const Bounds<double> bounds = bounds_of(nearer->shape);
  EXPECT_LE(bounds.lower.cwiseAbs().maxCoeff(), size);
  EXPECT_LE(bounds.upper.cwiseAbs().maxCoeff(), size);
  EXPECT_LE(largest_coordinate(nearer->shape), 8 * size);
  const Vec3<long double> moved =
      nearer->moved.high.cast<long double>() + nearer->moved.low.cast<long double>();
  Random random(2);
  for (int k = 0; k < 50; ++k) {
    const Vec3<double> n = random.direction();
    const Vec3<long double> there = furthest(nearer->shape, n) + moved;
    // Long double has 64 bits for one length, doubles 53 for the size; flat sides have many
    // furthest points.
    EXPECT_LE(std::abs((furthest(shape, n) - there).dot(n.cast<long double>())),
              0x1p-62L + 0x1p-51L * size);
  }
}

TEST(Recentred, has_the_same_points) {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const double size = std::exp2(random.uniform(-40, -6));
    const auto small = [&] { return Mat3<double>(random.rotation() * (size / 8)); };
    const auto off = [&] { return Vec3<double>(random.direction() * (size / 8)); };
    const Vec3<double> there = random.direction();
    const S disk = recentred_at(Disk{1}, there, small());
    expect_same_points(disk, size);
    expect_same_points(Rounded{size / 8, disk}, size);
    expect_same_points(MinkowskiSum{{disk, recentred_at(Box{{1, 1, 1}}, off(), small())}}, size);
    expect_same_points(HullOf{{disk, recentred_at(Sphere{1}, there + off(), small())}}, size);
    expect_same_points(Segment{{there, Vec3<double>(there + off())}}, size);
  }
}

TEST(Recentred, leaves_what_is_about_as_large_as_far_away) {
  const Mat3<double> one = Mat3<double>::Identity();
  const S ball = Sphere{1};
  EXPECT_FALSE(recentred(ball));
  EXPECT_FALSE(recentred(recentred_at(ball, {3, 0, 0}, one)));
  EXPECT_FALSE(recentred(S(MinkowskiSum{{ball, recentred_at(ball, {3, 0, 0}, one * 0.1)}})));
}

/// A sum of a part far to the left and one far to the right was left as it was, and rounded to how
/// far away they are.
TEST(Recentred, parts_that_are_far_away_are_moved_though_their_sum_is_near) {
  const Mat3<double> one = Mat3<double>::Identity();
  const S ball = Sphere{1};
  const Vec3<double> far(1e6 + 0.1, -3e5, 0.7);
  const S both = MinkowskiSum{{recentred_at(ball, far, one), recentred_at(ball, -far, one)}};
  const std::optional<Recentred> nearer = recentred(both);
  ASSERT_TRUE(nearer);
  EXPECT_TRUE(nearer->moved.is_zero());
  EXPECT_LT(largest_coordinate(nearer->shape), 4);
}

/// Turned, they were left as they were.
TEST(Recentred, nests_of_maps_are_moved_in_twice_the_digits) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const S triangle = Triangle{{Vec3<double>(100, 0, 0), {100, 0.01, 0}, {100, 0, 0.01}}};
    const S turned = recentred_at(triangle, 3 * random.direction(), random.rotation());
    expect_same_points(recentred_at(turned, -103 * random.direction(), random.rotation()), 1);
  }
}

/// Found by fuzzing: the paper's solver missed it, by a plane through the ray.
TEST(Recentred, a_small_disk_far_out_in_a_sum_is_hit_by_all_solvers) {
  Mat3<double> inner, outer;
  inner << -0.0007054550329165243, -0.09976394373753071, 0.07531041005818077,  //
      -0.09976394373753071, -0.04492533161691871, -0.06044725063263579,        //
      -0.07531041005818077, 0.06044725063263579, 0.07936921335016478;
  outer << -0.0019345998739611764, 0.003020158832482917, 0.00019343736941614424,  //
      -0.003020158832482917, -0.002344600656111179, 0.00010002167362302456,       //
      -0.001547498955329154, 0.0008001733889841965, -0.0004370311522312498;
  const S disk = recentred_at(Disk{8.763308869674802e-07}, {1.4529082380179551e-25, 1, -1}, inner);
  const S shape = recentred_at(Rounded{0, S(MinkowskiSum{{disk}})}, {0, 0, 0}, outer);
  const Ray<double> ray{{1.005653442745567, -0.004889244888332973, 5.449373823054858},
                        {-1.0028267213727835, 0.0024446224441664866, -5.448136618558679}};
  for (const Solver* const solver : {&solver::automatic, &solver::jet, &solver::gjk_alone}) {
    const CastOptions options{solver};
    const CastResult<double> answer = cast_ray(PreparedShape(shape), ray, options);
    // The error of the place exceeds the size.
    EXPECT_NE(answer.status, Status::miss) << name_in(named_solvers, solver);
  }
}

}  // namespace
}  // namespace minkray::testing
