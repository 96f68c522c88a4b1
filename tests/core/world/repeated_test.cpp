// SPDX-License-Identifier: MIT
// Many instances on one spot: rays get the answers that all of them give, and cast at two.
#include <gtest/gtest.h>

#include <array>

#include "core/exact/box.h"
#include "core/world/repeated.h"
#include "core/world/world.h"
#include "tests/support/shifted.h"
#include "tests/support/world_judge.h"

namespace minkray {
namespace {

using Pose = Affine<double>;

Pose at(const Vec3<double>& place) {
  return shifted_by(place);
}

/// `copies` of a turned box at the origin, between a near and a far sphere.
Instances pile(std::size_t copies) {
  Instances instances;
  instances.add(Shape{Sphere{0.5}}, at({0, 0, 20}));
  const Mat3<double> turn =
      Eigen::AngleAxisd(0.3, Vec3<double>(1, 2, 3).normalized()).toRotationMatrix();
  const std::uint32_t box = instances.define(Shape{Box{{1, 2, 0.5}}});
  for (std::size_t i = 0; i < copies; ++i) instances.add(box, Pose{turn, Vec3<double>::Zero()});
  instances.add(Shape{Sphere{0.5}}, at({0, 0, -20}));
  return instances;
}

const Ray<double> down{{0.1, 0.2, 10}, {0, 0, -1}};

TEST(Repeated, two_of_many_are_cast_at) {
  const World many(pile(100'000));
  QueryCounts counts;
  const WorldHit first = many.closest_hit(down, counts);
  EXPECT_EQ(first.instance, 1u);
  EXPECT_EQ(many.closest_hit(down, counts, 1).instance, 2u);
  EXPECT_EQ(many.closest_hit(down, counts, 2).instance, 1u);
  EXPECT_EQ(many.closest_hit(down, counts, 3).instance, 1u);
  EXPECT_TRUE(many.occluded(down, counts, 1));
  EXPECT_LT(counts.casts, 20u);

  QueryCounts alone;
  const World one(pile(1));
  EXPECT_EQ(one.closest_hit(down, alone).cast.t(), first.cast.t());
}

TEST(Repeated, rays_at_once_have_the_same_answers) {
  const World many(pile(1000));
  std::array<WorldRay, 70> rays;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    rays[i].ray = down;
    rays[i].ray.origin.x() += 0.01 * static_cast<double>(i);
    rays[i].skip = static_cast<std::uint32_t>(i % 4);
  }
  testing::Compared compared;
  compared.with_single_rays(many, rays);
  EXPECT_GT(compared.hits, 60u);
}

TEST(Repeated, other_shapes_places_and_ray_kinds_are_not_left_out) {
  Instances instances = pile(4);
  const auto expect_left_out = [&](const std::vector<std::uint32_t>& numbers) {
    const std::vector<RepeatedInstance> found = repeated_instances(instances);
    ASSERT_EQ(found.size(), numbers.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].number, numbers[i]);
      EXPECT_EQ(found[i].same_as, 1u);
    }
  };
  expect_left_out({3, 4});
  instances.show_to(3, 2);
  expect_left_out({4});
  instances.set_pose(1, at({0, 0, 1e-9}));
  EXPECT_TRUE(repeated_instances(instances).empty());
}

TEST(Repeated, instances_that_are_moved_apart_are_found) {
  World world(pile(5));
  world.pose_all([](std::size_t i) { return at({0, 5 * static_cast<double>(i), 0}); });
  QueryCounts counts;
  for (std::uint32_t i = 0; i < 7; ++i)
    EXPECT_EQ(world.closest_hit({{0.1, 5.0 * i, 10}, {0, 0, -1}}, counts).instance, i);
}

TEST(Repeated, what_no_ray_meets_costs_none) {
  Instances instances = pile(1);
  instances.add(Shape{Point{}}, at({0, 0, 5}));
  instances.replace(0, instances.definition_of(1));
  instances.replace(2, instances.definition_of(1));
  instances.set_pose(0, at({0, 0, 20}));
  instances.set_pose(2, at({0, 0, -20}));
  EXPECT_EQ(instances.kind_of_all(), FormKind::none);
  instances.show_to(3, 0);
  EXPECT_EQ(instances.kind_of_all(), exact::BoxForm::kind);
}

}  // namespace
}  // namespace minkray
