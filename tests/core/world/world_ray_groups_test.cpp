// SPDX-License-Identifier: MIT
// Rays that are asked for together get the answers that they get alone, bit for bit; and worlds
// whose instances have moved answer as worlds built where they are.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/scattered_world.h"

namespace minkray {
namespace {

using namespace testing;

template <class T>
class WorldRayGroupsOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WorldRayGroupsOf, Scalars);

TYPED_TEST(WorldRayGroupsOf, answers_are_those_of_single_rays) {
  using T = TypeParam;
  Scatter<T> random;
  const World<T> world(scattered_shapes(300, random));
  std::size_t rays = 0, hits = 0, blocked = 0;
  QueryCounts alone, together;
  for (const std::size_t count : {1u, 2u, 5u, 8u, 16u, 32u})
    for (int kind = 0; kind < 3; ++kind)
      for (int i = 0; i < 15; ++i) {
        const auto asked = bundle(random, kind, count, world.instances().size());
        std::vector<WorldHit<T>> answers(count);
        world.closest_hits(asked, answers, together);
        const RayGroupMask met = world.occluded(asked, together);
        EXPECT_TRUE(count == 32 || met >> count == 0);
        for (std::size_t k = 0; k < count; ++k, ++rays) {
          const WorldHit<T> hit = world.closest_hit(asked[k].ray, alone, asked[k].skip);
          EXPECT_TRUE(same(answers[k], hit)) << count << " rays of kind " << kind;
          EXPECT_EQ(bool(met >> k & 1), world.occluded(asked[k].ray, alone, asked[k].skip));
          EXPECT_EQ(bool(met >> k & 1), hit.found());
          hits += hit.found();
          blocked += met >> k & 1;
        }
      }
  EXPECT_GT(hits, rays * 3 / 10);
  EXPECT_LT(hits, rays * 9 / 10);
  EXPECT_EQ(blocked, hits);
  EXPECT_LT(together.nodes, alone.nodes);
}

TYPED_TEST(WorldRayGroupsOf, no_rays_and_no_world) {
  using T = TypeParam;
  Scatter<T> random;
  const World<T> world(scattered_shapes(20, random)), empty;
  QueryCounts counts;
  EXPECT_EQ(world.occluded(std::span<const WorldRay<T>>(), counts), 0u);
  world.closest_hits({}, {}, counts);
  EXPECT_EQ(counts.nodes, 0u);
  const auto asked = bundle<T>(random, 0, 8, 1);
  std::vector<WorldHit<T>> answers(asked.size());
  empty.closest_hits(asked, answers, counts);
  EXPECT_EQ(empty.occluded(asked, counts), 0u);
  for (const WorldHit<T>& hit : answers) {
    EXPECT_FALSE(hit.found());
    EXPECT_EQ(hit.cast.status, Status::miss);
  }
}

TYPED_TEST(WorldRayGroupsOf, of_instances_at_the_same_t_the_first_is_met) {
  using T = TypeParam;
  Scatter<T> random;
  for (const bool backwards : {false, true}) {
    Instances<T> pairs;
    std::vector<Affine<T>> poses;
    for (int i = 0; i < 50; ++i) poses.push_back(random.pose(5));
    for (int copy = 0; copy < 3; ++copy) {
      for (const Affine<T>& pose : poses) pairs.add(Shape<T>(Box<T>{{1, T(0.5), T(0.4)}}), pose);
      if (backwards) std::reverse(poses.begin(), poses.end());
    }
    const World<T> world(std::move(pairs));
    QueryCounts counts;
    int hits = 0;
    for (int i = 0; i < 100; ++i) {
      auto asked = bundle<T>(random, i % 2, 8, 1);
      for (WorldRay<T>& ray : asked) ray.skip = no_instance;
      std::vector<WorldHit<T>> answers(asked.size());
      world.closest_hits(asked, answers, counts);
      for (const WorldHit<T>& hit : answers) {
        if (!hit.found()) continue;
        EXPECT_LT(hit.instance, 50u);
        ++hits;
      }
    }
    EXPECT_GT(hits, 200);
  }
}

// Rays that come together find what is exhausted, too.
TYPED_TEST(WorldRayGroupsOf, other_solvers_are_asked_one_by_one) {
  using T = TypeParam;
  Scatter<T> random;
  CastOptions<T> impatient;
  impatient.solver = SolverKind::paper;
  impatient.max_iterations = 3;
  const World<T> world(scattered_shapes(100, random), impatient);
  QueryCounts together, alone;
  for (int i = 0; i < 100; ++i) {
    const auto asked = bundle<T>(random, 0, 16, 1);
    std::vector<WorldHit<T>> answers(asked.size());
    world.closest_hits(asked, answers, together);
    for (std::size_t k = 0; k < asked.size(); ++k)
      EXPECT_TRUE(same(answers[k], world.closest_hit(asked[k].ray, alone, asked[k].skip)));
  }
  EXPECT_GT(together.exhausted, 0u);
}

TYPED_TEST(WorldRayGroupsOf, the_build_of_the_hierarchy_does_not_show) {
  using T = TypeParam;
  Scatter<T> random, again;
  const World<T> quality(scattered_shapes(300, random)),
      speed(scattered_shapes(300, again), {}, BvhBuild::speed);
  QueryCounts counts;
  for (int i = 0; i < 1000; ++i) {
    const WorldRay<T> ray = bundle<T>(random, 2, 1, 300)[0];
    EXPECT_TRUE(same(quality.closest_hit(ray.ray, counts, ray.skip),
                     speed.closest_hit(ray.ray, counts, ray.skip)));
  }
}

// One world is the tree around what has moved, the other a tree built of it anew.
TYPED_TEST(WorldRayGroupsOf, moved_instances_answer_as_if_built_where_they_are) {
  using T = TypeParam;
  Scatter<T> random;
  std::vector<Affine<T>> poses(400);
  const Shape<T> shape = Rounded<T>{T(0.1), Shape<T>(Box<T>{{T(0.6), T(0.5), T(0.3)}})};
  const auto pose_of = [&](std::size_t i) { return poses[i]; };
  const auto instances = [&](bool alike) {
    Instances<T> made;
    made.add_many(made.define(shape), poses.size(), alike, pose_of);
    return made;
  };
  int hits = 0;
  for (const bool alike : {false, true}) {
    for (Affine<T>& pose : poses) pose = random.pose(6);
    if (alike)
      for (Affine<T>& pose : poses) pose.linear = poses[0].linear;
    World<T> world(instances(alike));
    for (int step = 0; step < 3; ++step) {
      for (Affine<T>& pose : poses) {
        const Affine<T> turn = random.pose(T(0.5));
        pose = {turn.linear * pose.linear, pose.translation + turn.translation};
      }
      poses[7].linear.setIdentity();
      world.pose_all(pose_of);
      const World<T> anew(instances(false));
      QueryCounts counts;
      for (int i = 0; i < 300; ++i) {
        const WorldRay<T> ray = bundle<T>(random, 2, 1, poses.size())[0];
        const WorldHit<T> hit = anew.closest_hit(ray.ray, counts, ray.skip);
        EXPECT_TRUE(same(world.closest_hit(ray.ray, counts, ray.skip), hit));
        hits += hit.found();
        if (!hit.found()) continue;
        EXPECT_EQ(world.instances().half_extent(hit.instance),
                  anew.instances().half_extent(hit.instance));
      }
    }
  }
  EXPECT_GT(hits, 500);
}

}  // namespace
}  // namespace minkray
