// SPDX-License-Identifier: MIT
// Distances are as precise wherever the two shapes are, and however large.
#include <gtest/gtest.h>

#include "tests/renderer/paper/random_poses.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using testing::at;
using testing::place;

TEST(Distance, does_not_depend_on_where_in_the_world_the_two_are) {
  const Shape cone = Cone{0.5, 1}, box = Box{{0.25, 0.5, 1}};
  const double near = distance_between(place(cone), place(box, at(2, 0.5, 1))).distance;
  const double far = distance_between(place(cone, at(1048576, -2097152, 4194304)),
                                      place(box, at(1048578, -2097151.5, 4194305)))
                         .distance;
  EXPECT_EQ(near, far);
}

TEST(Distance, scales_with_the_world) {
  testing::RandomPoses random(5);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    for (int i = 0; i < 40; ++i) {
      Affine<double> pose = random.pose(2);
      const Shape cylinder = Cylinder{1, 0.5}, cone = Cone{0.5, 1};
      const auto unit_sized = distance_between(place(cylinder), place(cone, pose));
      pose.linear *= scale;
      pose.translation *= scale;
      const Affine<double> scaled{Mat3<double>::Identity() * scale, Vec3<double>::Zero()};
      const auto result = distance_between(place(cylinder, scaled), place(cone, pose));
      EXPECT_EQ(result.status, unit_sized.status);
      EXPECT_NEAR(result.distance / scale, unit_sized.distance, 1e-13);
    }
  }
}

/// Squares of lengths beyond the range of numbers made overlaps of shapes far apart.
void expect_scales_to(int least_power, int greatest_power) {
  for (int power = least_power; power <= greatest_power; ++power) {
    const double size = static_cast<double>(std::pow(10.0, power));
    const Affine<double> far{shifted_by(0.0, 4.0 * size, 0.0)};
    const Shape ball = Sphere{size}, box = Box{Vec3<double>::Constant(size)};
    for (const auto& [a, b] : {std::pair(ball, ball), std::pair(ball, box), std::pair(box, box)}) {
      const auto result = distance_between(centred(a), centred(b, far));
      ASSERT_EQ(name_of(result.status), name_of(DistanceStatus::separated)) << power;
      ASSERT_NEAR(double(result.distance / size), 2, 1e-5) << power;
      ASSERT_NEAR(double(result.point_b.y() / size), 3, 1e-5) << power;
      const Affine<double> near{shifted_by(0.0, size, 0.0)};
      ASSERT_EQ(name_of(distance_between(centred(a), centred(b, near)).status),
                name_of(DistanceStatus::overlapping))
          << power;
    }
  }
}

TEST(Distance, scales_to_the_ends_of_the_number_range) {
  expect_scales_to(-290, 300);
  const auto none = distance_between(
      centred(Sphere{1}),
      centred(Sphere{1}, shifted_by(std::numeric_limits<double>::infinity(), 0, 0)));
  EXPECT_EQ(none.status, DistanceStatus::exhausted);
}

/// Neither the way between the middles nor the difference of the sizes shows how large they are.
void expect_overlap_in_one_place(const std::vector<int>& powers) {
  for (const int power : powers) {
    const double size = static_cast<double>(std::pow(10.0, power));
    const Shape ball = Sphere{size}, box = Box{Vec3<double>::Constant(size)};
    for (const auto& [a, b] : {std::pair(ball, ball), std::pair(box, box), std::pair(ball, box)})
      for (const double away : {0.0, std::numeric_limits<double>::min()}) {
        const auto result = distance_between(centred(a), centred(b, shifted_by(0.0, away, 0.0)));
        ASSERT_EQ(name_of(result.status), name_of(DistanceStatus::overlapping)) << power;
        ASSERT_LE(double((result.point_a - result.point_b).norm() / size), 1e-5) << power;
        ASSERT_LE(double(result.point_a.cwiseAbs().maxCoeff() / size), 1 + 1e-5) << power;
      }
  }
}

TEST(Distance, of_equal_shapes_in_one_place_is_none) {
  expect_overlap_in_one_place({-150, 0, 150});
}

/// Simplices on curved surfaces are slivers, with which the loop ended 1e-7 too early. The bounds
/// here are what more digits for the simplices leave.
void expect_precise(double allowed) {
  const auto error = [](const Shape& a, const Shape& b, const Vec3<double>& offset, double exact) {
    const auto result = distance_between(centred(a), centred(b, shifted_by(offset)));
    EXPECT_EQ(name_of(result.status), name_of(DistanceStatus::separated));
    EXPECT_LE(double(result.lower), exact * (1 + 4 * std::numeric_limits<double>::epsilon()));
    return std::abs(double(result.distance) - exact) / exact;
  };
  const Shape triangle =
      Triangle{{Vec3<double>(0, 0, 0), Vec3<double>(0.5, 0, 0), Vec3<double>(0, 0.5, 0)}};
  EXPECT_LE(error(Disk{1}, Box{{1, 1, 1}}, {1, 3, 0}, 1), allowed);
  EXPECT_LE(error(Sphere{3}, Box{{1, 1, 2}}, {-1, 4, 4}, std::sqrt(13.0) - 3), allowed);
  EXPECT_LE(error(triangle, Cylinder{2, 3}, {0, 3, 3}, 0.5), allowed);
}

TEST(Distance, of_curved_shapes_is_precise) {
  expect_precise(5e-9);
}

}  // namespace
}  // namespace minkray
