// SPDX-License-Identifier: MIT
// Near bodies are those that all pairs by themselves find to be near.
#include "renderer/clearance/near_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "core/derived/cube.h"

namespace minkray {
namespace {

/// Boxes, balls and a half-space under each turn.
PosedBodies scattered_bodies(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-2, 2);
  std::normal_distribution<double> turn;
  PosedBodies posed;
  for (std::size_t i = 0; i < count; ++i) {
    const Shape shape = i % 2 == 0 ? cube_of(0.3) : Shape(Sphere{0.4});
    posed.bodies.push_back({"body", "", -1, ContactShape(shape)});
    if (i % 10 == 9)
      posed.bodies.back().plane = PlacedPlane::of(Vec3<double>(0, 0, 1), -3, Affine<double>());
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(turn(random), turn(random), turn(random), turn(random)).normalized();
    posed.poses.push_back({q.toRotationMatrix(), {place(random), place(random), place(random)}});
  }
  return posed;
}

SignedDistance distance_of_two(const PosedBodies& first, std::size_t i, const PosedBodies& second,
                               std::size_t j) {
  const ClearanceBody &a = first.bodies[i], &b = second.bodies[j];
  const Affine<double>&pose_a = first.poses[i], &pose_b = second.poses[j];
  const auto to_plane = [](const PlacedPlane& plane, const Affine<double>& its_pose,
                           const ContactShape& shape, const Affine<double>& pose) {
    return distance_to_half_space(moved(plane, its_pose), shape, pose.linear,
                                  placed_middle(shape, pose));
  };
  if (a.plane) return to_plane(*a.plane, pose_a, b.shape, pose_b);
  if (b.plane) return to_plane(*b.plane, pose_b, a.shape, pose_a);
  return signed_distance(a.shape, pose_a, b.shape, pose_b);
}

TEST(NearBodies, are_those_of_all_pairs) {
  std::mt19937 random(3);
  const PosedBodies first = scattered_bodies(40, random), others = scattered_bodies(60, random);
  const auto wanted = [](std::size_t a, std::size_t b) { return (a + b) % 3 == 0; };
  for (const double within : {0.0, 0.5, std::numeric_limits<double>::infinity()}) {
    std::map<std::pair<std::size_t, std::size_t>, double> expected;
    const auto expect = [&](std::size_t i, const PosedBodies& second, std::size_t j,
                            std::size_t number) {
      if (first.bodies[i].plane && second.bodies[j].plane) return;
      const SignedDistance found = distance_of_two(first, i, second, j);
      if (!(found.lower > within)) expected[{i, number}] = found.value;
    };
    for (std::size_t i = 0; i < first.bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < first.bodies.size(); ++j)
        if (wanted(i, j)) expect(i, first, j, j);
      for (std::size_t j = 0; j < others.bodies.size(); ++j)
        expect(i, others, j, first.bodies.size() + j);
    }
    const std::vector<NearBodies> found =
        near_bodies(first, others, wanted, {.within = within, .tolerance = 1e-10});
    EXPECT_EQ(found.size(), expected.size());
    EXPECT_GT(found.size(), 50u);
    EXPECT_TRUE(std::ranges::is_sorted(found, {},
                                       [](const NearBodies& pair) { return pair.distance.value; }));
    for (const NearBodies& pair : found) {
      ASSERT_TRUE(expected.contains({pair.a, pair.b})) << pair.a << " and " << pair.b;
      EXPECT_NEAR(pair.distance.value, (expected[{pair.a, pair.b}]), 1e-9);
      const Vec3<double> apart = pair.distance.point_b - pair.distance.point_a;
      EXPECT_LT((apart - pair.distance.value * pair.distance.normal).norm(), 1e-5);
    }
  }
}

}  // namespace
}  // namespace minkray
