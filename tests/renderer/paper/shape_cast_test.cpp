// SPDX-License-Identifier: MIT
#include "renderer/paper/shape_cast.h"

#include <gtest/gtest.h>

#include "renderer/paper/distance.h"
#include "renderer/paper/solvers.h"
#include "tests/renderer/paper/random_poses.h"

namespace minkray {
namespace {

using V = Vec3<double>;
using testing::at;
using testing::pair_of;
using testing::RandomPoses;

TEST(ShapeCast, ends_where_bisection_on_the_distance_ends_with_every_solver) {
  RandomPoses random(2);
  const std::array<Shape, 5> shapes = {Shape(Cone{0.7, 0.5}), Cylinder{0.4, 0.8},
                                       Ellipsoid{{1, 0.5, 0.25}}, Box{{0.3, 0.6, 0.9}},
                                       TaperedCapsule{{0.2, 0.5}, 0.6}};
  for (int i = 0; i < 60; ++i) {
    const Affine<double> pose_a = random.pose(1);
    Affine<double> pose_b = random.pose(1);
    const V from = random.in_cube(1).normalized() * 4;
    const V d = -from;
    pose_b.translation = pose_a.translation + from + random.in_cube(0.3);
    const auto& A = shapes[static_cast<std::size_t>(i) % 5];
    const auto& B = shapes[static_cast<std::size_t>(i / 5) % 5];
    const auto pair = pair_of(A, pose_a, B, pose_b);
    const auto overlap_at = [&](double t) {
      CentredShape moved = pair.b();
      moved.centre += t * d;
      return distance_between(pair.a(), moved).status == DistanceStatus::overlapping;
    };
    double apart = 0, together = 1;
    if (overlap_at(apart) || !overlap_at(together)) continue;
    while (together - apart > 1e-15) {
      const double middle = (apart + together) / 2;
      if (middle <= apart || middle >= together) break;
      (overlap_at(middle) ? together : apart) = middle;
    }
    for (const auto& solver : named_solvers) {
      const CastOptions options{solver.kind};
      const auto result = cast_shape(pair, d, 1, options);
      const bool is_determinant =
          solver.kind == &solver::paper_johnson || solver.kind == &solver::paper_signed_volumes;
      // Those two may not converge on slivers, but are never wrong.
      if (is_determinant && result.cast.status == Status::exhausted) continue;
      ASSERT_EQ(result.cast.status, Status::hit) << i << " " << solver.name;
      EXPECT_NEAR(result.cast.t(), together, is_determinant ? 1e-6 : 1e-12)
          << i << " " << solver.name;
    }
  }
}

TEST(ShapeCast, does_not_depend_on_where_in_the_world_the_two_are) {
  const Shape A = Box{{1, 2, 3}}, B = Cone{0.5, 1};
  const Mat3<double> turn = rotation_matrix(0.1, 0.2, 0.3, 0.9);
  const V far(1 << 20, -(1 << 22), 1 << 24), o(-5, 0.25, 0.5), d(1, 0.125, 0);
  const auto here = cast_shape(pair_of(A, {}, B, {turn, o}), d);
  const auto there = cast_shape(pair_of(A, at(far), B, {turn, o + far}), d);
  ASSERT_EQ(here.cast.status, Status::hit);
  EXPECT_EQ(there.cast.t(), here.cast.t());
  EXPECT_EQ(there.cast.normal, here.cast.normal);
}

TEST(ShapeCast, standing_still_and_denormal_velocities_return) {
  const auto apart = pair_of(Box{{0.5, 0.5, 0.5}}, {}, Box{{0.5, 0.5, 0.5}}, at(V(0, 1.1, 0)));
  const auto overlapping = pair_of(Box{{0.5, 0.5, 0.5}}, {}, Sphere{0.5}, at(V(0, 0.9, 0)));
  constexpr double least = std::numeric_limits<double>::denorm_min();
  for (const V& d : {V(0, 0, 0), V(0, -least, 0), V(0, -1e-310, 0), V(1e-300, -1e-300, 0)}) {
    EXPECT_EQ(cast_shape(apart, d, 1).cast.status, Status::miss) << d.transpose();
    const auto result = cast_shape(overlapping, d, 1);
    EXPECT_EQ(result.cast.status, Status::inside) << d.transpose();
    EXPECT_EQ(result.cast.t(), 0.0);
  }
}

TEST(ShapeCast, receding_misses_and_t_max_is_exact_to_rounding) {
  const auto pair = pair_of(Box{{0.5, 0.5, 0.5}}, {}, Sphere{0.5}, at(V(0, 3, 0)));
  EXPECT_EQ(cast_shape(pair, V(0, 1, 0)).cast.status, Status::miss);
  // Contact is at t = 2.
  EXPECT_EQ(cast_shape(pair, V(0, -1, 0), 2 - 1e-12).cast.status, Status::miss);
  EXPECT_EQ(cast_shape(pair, V(0, -1, 0), 2 + 1e-12).cast.status, Status::hit);
  const auto hit = cast_shape(pair, V(0, -1, 0), 2 + 1e-12);
  EXPECT_NEAR(hit.cast.t(), 2, 1e-15);
  EXPECT_NEAR(hit.point_a.y(), 0.5, 1e-15);
  EXPECT_NEAR(hit.point_b.y(), 0.5, 1e-15);
  EXPECT_NEAR(hit.cast.normal.y(), 1, 1e-15);
}

TEST(ShapeCast, touching_at_the_start_is_inside_when_approaching) {
  const auto touching = pair_of(Box{{1, 1, 1}}, {}, Box{{1, 1, 1}}, at(V(0, 2, 0)));
  const auto result = cast_shape(touching, V(0, -1, 0), 1);
  EXPECT_EQ(result.cast.status, Status::inside);
  EXPECT_EQ(result.cast.t(), 0.0);
  // Barely apart: a hit, at once.
  const auto apart = pair_of(Box{{1, 1, 1}}, {}, Box{{1, 1, 1}}, at(V(0, 2 + 1e-9, 0)));
  const auto hit = cast_shape(apart, V(0, -1, 0), 1);
  EXPECT_EQ(hit.cast.status, Status::hit);
  EXPECT_NEAR(hit.cast.t(), 1e-9, 1e-15);
}

/// A cylinder that touches a plate's edge with its rim, and a box that comes down on a disk's: in
/// double no solver could decide.
TEST(ShapeCast, rims_and_edges_that_touch_are_told) {
  for (const double scale : {1.0, 1e-3}) {
    const Shape cylinder = Cylinder{scale, scale}, plate = Box{{scale, scale, 0}};
    const auto touching = pair_of(plate, {}, cylinder, at(scale * V(2, 0, 1)));
    EXPECT_EQ(name_of(cast_shape(touching, V(0, scale, 0)).cast.status), name_of(Status::inside))
        << scale;
  }
  constexpr double half = 1.220631673816707;
  const auto pair = pair_of(Disk{0.5}, {}, Box{{1, half, 1}}, at(V(-1, 9, 1)));
  const auto hit = cast_shape(pair, V(0, -1, 0));
  ASSERT_EQ(name_of(hit.cast.status), name_of(Status::hit));
  EXPECT_NEAR(hit.cast.t(), 9 - half - 0.5, 4e-15);
}

TEST(ShapeCast, of_two_moving_shapes_is_that_of_their_relative_motion) {
  const auto pair = pair_of(Sphere{1}, {}, Sphere{1}, at(V(10, 0, 0)));
  const auto result = cast_shapes(pair, V(1, 1, 0), V(-1, 1, 0), 10);
  ASSERT_EQ(result.cast.status, Status::hit);
  EXPECT_NEAR(result.cast.t(), 4, 1e-14);
  EXPECT_LT((result.point_a - V(5, 4, 0)).norm(), 1e-13);
  EXPECT_LT((result.point_b - V(5, 4, 0)).norm(), 1e-13);
}

TEST(ShapeCast, of_two_moving_shapes_that_miss_has_no_points) {
  // The balls pass by each other at 2.12, 10 from where they begin; a box around both would be
  // met.
  const auto pair = pair_of(Sphere{1}, {}, Sphere{1}, at(V(10, 1.5, 1.5)));
  for (const auto& solver : named_solvers) {
    const CastOptions options{solver.kind};
    const auto result = cast_shapes(pair, V(1, 1, 0), V(-1, 1, 0), 10, options);
    ASSERT_EQ(result.cast.status, Status::miss) << solver.name;
    EXPECT_EQ(result.point_a, V(0, 0, 0)) << solver.name;
    EXPECT_EQ(result.point_b, V(0, 0, 0)) << solver.name;
  }
}

TEST(ShapeCast, contact_points_of_the_largest_bodies_are_numbers) {
  const double most = 1.7e308;
  for (const Shape& moving : {Shape(Sphere{most}), Shape(Cylinder{most, 1})}) {
    const auto pair = pair_of(Sphere{1}, {}, moving, {});
    const auto result = cast_shape(pair, V(1, 0, 0), 1);
    EXPECT_NE(name_of(result.cast.status), name_of(Status::miss));
    EXPECT_TRUE(result.point_a.allFinite() && result.point_b.allFinite());
  }
}

TEST(ShapeCast, begun_with_the_last_frames_axis_needs_one_support_to_miss_again) {
  auto pair = pair_of(Box{{1, 2, 0.5}}, {rotation_matrix(0.1, 0.3, 0.2, 1.0), V::Zero()},
                      Cylinder{0.5, 1}, at(V(3, 2.5, 1)));
  const V d(-1, 0.5, 0.25);
  CastOptions options;
  options.solver = &solver::gjk_alone;
  const auto first = cast_shape(pair, d, 1, options);
  ASSERT_EQ(first.cast.status, Status::miss);
  options.v0 = first.cast.normal;
  pair.place(pair.a().centre, pair.b().centre + V(0.01, 0, 0));
  const auto second = cast_shape(pair, d, 1, options);
  EXPECT_EQ(second.cast.status, Status::miss);
  EXPECT_EQ(second.cast.iterations, 1);
}

}  // namespace
}  // namespace minkray
