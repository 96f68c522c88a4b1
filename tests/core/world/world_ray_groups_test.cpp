// SPDX-License-Identifier: MIT
// Rays that are asked for together get the answers that they get alone, bit for bit; and worlds
// whose instances have moved answer as worlds built where they are.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "core/world/world.h"

namespace minkray {
namespace {

template <class T>
class WorldRayGroupsOf : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(WorldRayGroupsOf, Scalars);

template <class T>
struct Random {
  std::mt19937 generator{5};
  T within(T low, T high) { return std::uniform_real_distribution<T>(low, high)(generator); }
  Vec3<T> point(T size) { return {within(-size, size), within(-size, size), within(-size, size)}; }
  Affine<T> pose(T size) {
    const Vec3<T> axis = point(1);
    return {rotation_matrix(axis.x(), axis.y(), axis.z(), within(-1, 1)), point(size)};
  }
};

/// Shapes have models for packets or none; some stand in the same place twice.
template <class T>
Instances<T> scattered_shapes(int count, Random<T>& random) {
  const std::vector<Shape<T>> kinds = {
      Sphere<T>{T(0.7)},
      Rounded<T>{T(0.1), Shape<T>(Box<T>{{T(0.6), T(0.5), T(0.3)}})},
      Ellipsoid<T>{{T(1), T(0.5), T(0.2)}},
      Cylinder<T>{T(0.3), T(0.8)},
      MinkowskiSum<T>{{Shape<T>(Ellipsoid<T>{{T(0.4), T(0.3), T(0.2)}}),
                       Shape<T>(Box<T>{{T(0.3), T(0.3), T(0.1)}})}},
      Triangle<T>{{Vec3<T>(0, 0, 0), Vec3<T>(1, 0, 0), Vec3<T>(0, 1, 0)}}};
  Instances<T> shapes;
  for (int i = 0; i < count; ++i) {
    const Shape<T>& kind = kinds[static_cast<std::size_t>(i) % kinds.size()];
    const Affine<T> pose = random.pose(6);
    for (int twice = 0; twice < (i % 10 == 0 ? 2 : 1); ++twice) shapes.add(kind, pose);
  }
  return shapes;
}

/// Rays as a camera's, as towards a far light, or as they come.
template <class T>
std::vector<WorldRay<T>> bundle(Random<T>& random, int kind, std::size_t count,
                                std::size_t instances) {
  const Vec3<T> from = random.point(12), towards = random.point(5) - from;
  std::vector<WorldRay<T>> rays;
  for (std::size_t i = 0; i < count; ++i) {
    Ray<T> ray{from, towards + random.point(T(0.3))};
    if (kind == 1) ray = {from + random.point(1), towards};
    if (kind == 2) ray = {random.point(7), random.point(1)};
    if (i % 5 == 0) ray.t_max = random.within(T(0.3), T(1.2));
    const auto skip = static_cast<std::uint32_t>(random.within(0, static_cast<T>(instances)));
    rays.push_back({ray, i % 4 == 0 ? skip : no_instance});
  }
  return rays;
}

template <class T>
testing::AssertionResult same(const WorldHit<T>& a, const WorldHit<T>& b) {
  const CastResult<T>&x = a.cast, &y = b.cast;
  if (a.instance != b.instance)
    return testing::AssertionFailure()
           << a.instance << " and " << b.instance << " at " << x.t() << " and " << y.t();
  if (x.status != y.status) return testing::AssertionFailure() << "status";
  if (!a.found()) return testing::AssertionSuccess();
  if (x.t_base != y.t_base || x.t_offset != y.t_offset || x.offset_lo != y.offset_lo ||
      x.offset_hi != y.offset_hi)
    return testing::AssertionFailure() << "t " << x.t() << " and " << y.t();
  if (x.normal != y.normal) return testing::AssertionFailure() << "normal";
  return testing::AssertionSuccess();
}

TYPED_TEST(WorldRayGroupsOf, answers_are_those_of_single_rays) {
  using T = TypeParam;
  Random<T> random;
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
  Random<T> random;
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
  Random<T> random;
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
  Random<T> random;
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
  Random<T> random, again;
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
  Random<T> random;
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
