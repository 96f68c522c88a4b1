// SPDX-License-Identifier: MIT
#include "renderer/paper/distance.h"

#include <gtest/gtest.h>

#include "tests/oracle/wolfe.h"
#include "tests/renderer/paper/random_poses.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using testing::at;
using testing::place;

constexpr std::array all_kinds = {SubalgorithmKind::projection, SubalgorithmKind::johnson,
                                  SubalgorithmKind::signed_volumes};

template <int Dim>
double wolfe_distance(const std::vector<Vec3<double>>& a, const std::vector<Vec3<double>>& b,
                      const Vec3<double>& shift) {
  std::vector<oracle::Column<Dim>> differences;
  for (const Vec3<double>& p : a)
    for (const Vec3<double>& q : b) {
      const oracle::Column<3> d =
          p.cast<long double>() - q.cast<long double>() - shift.cast<long double>();
      differences.push_back(d.template head<Dim>());
    }
  return static_cast<double>(oracle::nearest_to_origin<Dim>(differences).norm());
}

/// The answer proves itself: the points are in the shapes' slabs, the planes between them.
template <int Dim>
void expect_certified(const CentredShape& a, const CentredShape& b,
                      const DistanceResult<double, Dim>& result, double size) {
  const double rounding = 64.0 * tolerance::epsilon<double> * size;
  if (result.status != DistanceStatus::separated) return;
  Vec3<double> axis = Vec3<double>::Zero();
  axis.template head<Dim>() = result.axis;
  const double top_of_a = axis.dot(a.about_centre.support(axis) + a.centre);
  const double foot_of_b = axis.dot(b.about_centre.support(Vec3<double>(-axis)) + b.centre);
  EXPECT_GE(foot_of_b - top_of_a, result.lower - rounding);
  EXPECT_NEAR((result.point_b - result.point_a).norm(), result.distance, rounding);
  EXPECT_LE(result.distance - result.lower, rounding);
  EXPECT_LE(result.axis.dot(result.point_a), top_of_a + rounding);
  EXPECT_GE(result.axis.dot(result.point_b), foot_of_b - rounding);
}

// Johnson's determinants lose digits on slivers; what remains is measured by `minkray paper`.
double slack(SubalgorithmKind kind) {
  return kind == SubalgorithmKind::johnson ? 1e-9 : 1e-14;
}

TEST(Distance, of_random_hulls_is_that_of_wolfes_method) {
  testing::RandomPoses random(1);
  int overlapping = 0;
  constexpr int pairs = 400;
  for (int i = 0; i < pairs; ++i) {
    const auto a = random.points(12, false), b = random.points(9, false);
    const Vec3<double> shift = random.in_cube(1.6);
    const double expected = wolfe_distance<3>(a, b, shift);
    const auto A = place(Hull{PointCloud(a)});
    const auto B = place(Hull{PointCloud(b)}, shifted_by(shift));
    for (const SubalgorithmKind kind : all_kinds) {
      const DistanceResult<double, 3> result = distance_between(A, B, {}, kind);
      EXPECT_NE(result.status, DistanceStatus::exhausted) << i;
      EXPECT_NEAR(result.distance, expected, 4 * slack(kind)) << i << " " << int(kind);
    }
    expect_certified(A, B, distance_between(A, B), 4.0);
    overlapping += expected < 1e-12;
  }
  EXPECT_GT(overlapping, pairs * 3 / 10);
  EXPECT_LT(overlapping, pairs * 7 / 10);
}

TEST(Distance, in_the_plane_is_wolfes_and_that_of_flat_shapes_in_space) {
  testing::RandomPoses random(2);
  int overlapping = 0;
  constexpr int pairs = 400;
  for (int i = 0; i < pairs; ++i) {
    const auto a = random.points(7, true), b = random.points(5, true);
    Vec3<double> shift = random.in_cube(1.8);
    shift.z() = 0;
    const double expected = wolfe_distance<2>(a, b, shift);
    const auto A = place(Hull{PointCloud(a)});
    const auto B = place(Hull{PointCloud(b)}, shifted_by(shift));
    for (const SubalgorithmKind kind : all_kinds)
      EXPECT_NEAR(distance_in_plane(A, B, {}, kind).distance, expected, 4 * slack(kind)) << i;
    EXPECT_NEAR(distance_between(A, B).distance, expected, 1e-13) << i;
    expect_certified(A, B, distance_in_plane(A, B), 4.0);
    overlapping += expected < 1e-12;
  }
  EXPECT_GT(overlapping, pairs * 3 / 10);
  EXPECT_LT(overlapping, pairs * 7 / 10);
}

TEST(Distance, has_the_closed_form_of_balls_boxes_and_capsules) {
  testing::RandomPoses random(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3<double> h = random.in_cube(1).cwiseAbs() + Vec3<double>::Constant(0.1);
    const Vec3<double> g = random.in_cube(1).cwiseAbs() + Vec3<double>::Constant(0.1);
    const Vec3<double> c = random.in_cube(5);
    const double r = random.in(0.1, 1), q = random.in(0.1, 1);
    const auto check = [&](const Shape& a, const Shape& b, double expected) {
      const auto A = place(a), B = place(b, shifted_by(c));
      const auto result = distance_between(A, B);
      EXPECT_NEAR(result.distance, std::max(expected, 0.0), 4e-14) << i;
      expect_certified(A, B, result, 10.0);
    };
    const Vec3<double> zero = Vec3<double>::Zero();
    check(Sphere{r}, Sphere{q}, c.norm() - r - q);
    check(Box{h}, Box{g}, (c.cwiseAbs() - h - g).cwiseMax(zero).norm());
    check(Box{h}, Sphere{q}, (c.cwiseAbs() - h).cwiseMax(zero).norm() - q);
    const Vec3<double> from_axis(c.x(), c.y(), std::max(std::abs(c.z()) - h.z() - g.z(), 0.0));
    check(Capsule{r, h.z()}, Capsule{q, g.z()}, from_axis.norm() - r - q);
  }
}

TEST(Distance, of_deep_overlap_is_zero_and_says_so) {
  testing::RandomPoses random(4);
  for (int i = 0; i < 200; ++i) {
    const Affine<double> pose = random.pose(0.3);
    const auto ball = place(Ellipsoid{{1, 0.7, 0.5}}, pose);
    const auto box = place(Box{{1, 2, 0.5}});
    for (const SubalgorithmKind kind : all_kinds) {
      const auto result = distance_between(box, ball, {}, kind);
      EXPECT_EQ(result.status, DistanceStatus::overlapping) << i;
      EXPECT_EQ(result.distance, 0.0);
      EXPECT_EQ(result.certificate, 0.0);
      // The point that it names is common to both.
      EXPECT_NEAR((result.point_a - result.point_b).norm(), 0.0, 1e-12);
      EXPECT_TRUE(
          (result.point_a.cwiseAbs().array() <= Vec3<double>(1, 2, 0.5).array() + 1e-12).all());
      const Vec3<double> local = pose.inverse()(result.point_b);
      EXPECT_LE(local.cwiseQuotient(Vec3<double>(1, 0.7, 0.5)).norm(), 1 + 1e-12);
    }
  }
}

TEST(Distance, of_a_touching_rim_is_overlap) {
  const auto result =
      distance_between(centred(Box{{3, 1, 1}}), centred(Cone{1, 3}, shifted_by(4, 0, 2)));
  EXPECT_EQ(name_of(result.status), name_of(DistanceStatus::overlapping));
}

TEST(Distance, of_touching_boxes_is_zero_and_of_barely_parted_ones_the_gap) {
  const auto box = place(Box{{1, 1, 1}});
  EXPECT_EQ(distance_between(box, place(Box{{1, 1, 1}}, at(2, 0.5, 0.25))).status,
            DistanceStatus::overlapping);
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const auto result = distance_between(box, place(Box{{1, 1, 1}}, at(2 + gap, 0.5, 0.25)));
    EXPECT_EQ(result.status, DistanceStatus::separated) << gap;
    EXPECT_NEAR(result.distance, gap, 4e-16) << gap;
    EXPECT_NEAR(result.axis.x(), 1.0, 1e-12) << gap;
  }
}

TEST(Distance, begun_with_the_answers_axis_ends_at_once_and_separation_needs_one_support) {
  const auto box = place(Box{{1, 2, 3}});
  const auto cone = place(Cone{1, 1}, {rotation_matrix(0.1, 0.2, 0.3, 1.0), {3, 3, 4}});
  const auto cold = distance_between(box, cone);
  DistanceOptions<double, 3> options;
  options.v0 = cold.axis;
  const auto warm = distance_between(box, cone, options);
  EXPECT_LT(warm.iterations, cold.iterations);
  EXPECT_NEAR(warm.distance, cold.distance, 1e-14);
  options.only_separation = true;
  const auto separation = distance_between(box, cone, options);
  EXPECT_EQ(separation.status, DistanceStatus::separated);
  EXPECT_EQ(separation.iterations, 1);
  EXPECT_TRUE(std::isinf(separation.distance)) << "none is asked for";
}

TEST(Distance, is_looked_for_no_longer_than_asked_and_each_step_is_told) {
  testing::RandomPoses random(17);
  const Shape flat = Ellipsoid{{1, 1, 0.01}}, thin = Ellipsoid{{0.01, 1, 1}};
  for (const int most : {1, 3, 6, 9, 12, 15, 20, 100}) {
    for (int k = 0; k < 50; ++k) {
      DistanceOptions<double, 3> options;
      options.max_iterations = most;
      int message = 0;
      const auto result =
          distance_between(place(flat), place(thin, random.pose(2)), options,
                           SubalgorithmKind::projection, [&](const auto&) { ++message; });
      ASSERT_GT(message, 0) << k;
      ASSERT_LE(message, result.iterations) << k;
      ASSERT_LE(result.iterations, most < 100 ? most : 1000) << k;
    }
  }
}

}  // namespace
}  // namespace minkray
