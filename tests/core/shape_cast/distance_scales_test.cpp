// SPDX-License-Identifier: MIT
// Distances are as precise wherever the two shapes are, and however large.
#include <gtest/gtest.h>

#include "tests/core/shape_cast/random_poses.h"

namespace minkray {
namespace {

using testing::at;
using testing::place;

TEST(Distance, does_not_depend_on_where_in_the_world_the_two_are) {
  const Shape<double> cone = Cone<double>{0.5, 1}, box = Box<double>{{0.25, 0.5, 1}};
  const double near =
      distance_between(place<double>(cone), place<double>(box, at(2, 0.5, 1))).distance;
  const double far = distance_between(place<double>(cone, at(1048576, -2097152, 4194304)),
                                      place<double>(box, at(1048578, -2097151.5, 4194305)))
                         .distance;
  EXPECT_EQ(near, far);
}

TEST(Distance, scales_with_the_world) {
  testing::RandomPoses random(5);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    for (int i = 0; i < 40; ++i) {
      Affine<double> pose = random.pose(2);
      const Shape<double> cylinder = Cylinder<double>{1, 0.5}, cone = Cone<double>{0.5, 1};
      const auto unit_sized = distance_between(place<double>(cylinder), place<double>(cone, pose));
      pose.linear *= scale;
      pose.translation *= scale;
      const Affine<double> scaled{Mat3<double>::Identity() * scale, Vec3<double>::Zero()};
      const auto result =
          distance_between(place<double>(cylinder, scaled), place<double>(cone, pose));
      EXPECT_EQ(result.status, unit_sized.status);
      EXPECT_NEAR(result.distance / scale, unit_sized.distance, 1e-13);
    }
  }
}

/// Squares of lengths beyond the range of numbers made overlaps of shapes far apart.
template <class T>
void expect_scales_to(int least_power, int greatest_power) {
  for (int power = least_power; power <= greatest_power; ++power) {
    const T size = static_cast<T>(std::pow(10.0, power));
    const Affine<T> far{Mat3<T>::Identity(), {T(0), T(4) * size, T(0)}};
    const Shape<T> ball = Sphere<T>{size}, box = Box<T>{Vec3<T>::Constant(size)};
    for (const auto& [a, b] : {std::pair(ball, ball), std::pair(ball, box), std::pair(box, box)}) {
      const auto result = distance_between(centred<T>(a), centred<T>(b, far));
      ASSERT_EQ(name_of(result.status), name_of(DistanceStatus::separated)) << power;
      ASSERT_NEAR(double(result.distance / size), 2, 1e-5) << power;
      ASSERT_NEAR(double(result.point_b.y() / size), 3, 1e-5) << power;
      const Affine<T> near{Mat3<T>::Identity(), {T(0), size, T(0)}};
      ASSERT_EQ(name_of(distance_between(centred<T>(a), centred<T>(b, near)).status),
                name_of(DistanceStatus::overlapping))
          << power;
    }
  }
}

TEST(Distance, scales_to_the_ends_of_the_number_range) {
  expect_scales_to<float>(-30, 36);
  expect_scales_to<double>(-290, 300);
  const auto none = distance_between(
      centred<float>(Sphere<float>{1}),
      centred<float>(Sphere<float>{1},
                     {Mat3<float>::Identity(), {std::numeric_limits<float>::infinity(), 0, 0}}));
  EXPECT_EQ(none.status, DistanceStatus::exhausted);
}

/// Neither the way between the middles nor the difference of the sizes shows how large they are.
template <class T>
void expect_overlap_in_one_place(const std::vector<int>& powers) {
  for (const int power : powers) {
    const T size = static_cast<T>(std::pow(10.0, power));
    const Shape<T> ball = Sphere<T>{size}, box = Box<T>{Vec3<T>::Constant(size)};
    for (const auto& [a, b] : {std::pair(ball, ball), std::pair(box, box), std::pair(ball, box)})
      for (const T away : {T(0), std::numeric_limits<T>::min()}) {
        const auto result = distance_between(
            centred<T>(a), centred<T>(b, {Mat3<T>::Identity(), {T(0), away, T(0)}}));
        ASSERT_EQ(name_of(result.status), name_of(DistanceStatus::overlapping)) << power;
        ASSERT_LE(double((result.point_a - result.point_b).norm() / size), 1e-5) << power;
        ASSERT_LE(double(result.point_a.cwiseAbs().maxCoeff() / size), 1 + 1e-5) << power;
      }
  }
}

TEST(Distance, of_equal_shapes_in_one_place_is_none) {
  expect_overlap_in_one_place<float>({-15, 0, 15});
  expect_overlap_in_one_place<double>({-150, 0, 150});
}

/// Simplices on curved surfaces are slivers, with which the loop ended 1e-7 too early in double,
/// and 2e-3 in float. The bounds here are what more digits for the simplices leave.
template <class T>
void expect_precise(double allowed) {
  const auto error = [](const Shape<double>& a, const Shape<double>& b, const Vec3<double>& offset,
                        double exact) {
    const auto result =
        distance_between(centred<T>(convert<T>(a)),
                         centred<T>(convert<T>(b), {Mat3<T>::Identity(), offset.cast<T>()}));
    EXPECT_EQ(name_of(result.status), name_of(DistanceStatus::separated));
    EXPECT_LE(double(result.lower), exact * (1 + 4 * double(std::numeric_limits<T>::epsilon())));
    return std::abs(double(result.distance) - exact) / exact;
  };
  const Shape<double> triangle =
      Triangle<double>{{Vec3<double>(0, 0, 0), Vec3<double>(0.5, 0, 0), Vec3<double>(0, 0.5, 0)}};
  EXPECT_LE(error(Disk<double>{1}, Box<double>{{1, 1, 1}}, {1, 3, 0}, 1), allowed);
  EXPECT_LE(error(Sphere<double>{3}, Box<double>{{1, 1, 2}}, {-1, 4, 4}, std::sqrt(13.0) - 3),
            allowed);
  EXPECT_LE(error(triangle, Cylinder<double>{2, 3}, {0, 3, 3}, 0.5), allowed);
}

TEST(Distance, of_curved_shapes_is_precise) {
  expect_precise<float>(4e-6);  // a few epsilon of sizes eight times the distance
  expect_precise<double>(5e-9);
}

}  // namespace
}  // namespace minkray
