// SPDX-License-Identifier: MIT
// Meshes in worlds: next to shapes and half-spaces, posed, moving, and in all kinds of queries.
#include <gtest/gtest.h>

#include <cmath>

#include "core/world/world.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"
#include "tests/support/shifted.h"
#include "tests/support/world_judge.h"

namespace minkray {
namespace {

using MeshPointer = std::shared_ptr<const TriangleMesh>;

Affine<double> random_pose(testing::Random& random, double reach) {
  return {random.rotation(), reach * random.in_cube()};
}

/// Shapes, meshes and a half-space, each kind often between others.
World mixed_world(int seed) {
  testing::Random random(static_cast<std::uint64_t>(seed));
  const MeshPointer ball = testing::bumpy_ball(20, 24).shared(),
                    ring = testing::torus(24, 16).shared();
  Instances instances;
  instances.add(HalfSpaceBody<double>{Vec3<double>::UnitZ(), -6});
  for (int i = 0; i < 60; ++i) {
    const Affine<double> pose = random_pose(random, 5);
    if (i % 3 == 0)
      instances.add(Box{{0.3, 0.4, 0.5}}, pose);
    else
      instances.add(i % 3 == 1 ? ball : ring, pose);
  }
  return World(std::move(instances));
}

Ray<double> random_ray(testing::Random& random) {
  const Vec3<double> from = 9 * random.direction();
  return {from, 5 * random.in_cube() - from};
}

TEST(MeshWorld, finds_the_first_of_all_however_rays_are_asked) {
  const World world = mixed_world(1);
  testing::Random random(2);
  std::vector<WorldRay> rays;
  for (int i = 0; i < 3000; ++i) rays.push_back({random_ray(random)});
  // Blocks of neighbours.
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x)
      rays.push_back({{{0, -12, 1}, {0.01 * (x - 20), 1, 0.01 * (y - 20)}}});
  testing::Compared compared;
  compared.with_single_rays(world, rays);
  QueryCounts counts;
  int meshes = 0, shapes = 0;
  for (const WorldRay& ray : rays) {
    const WorldHit first = testing::first_of_all(world, ray);
    ASSERT_TRUE(testing::same(world.closest_hit(ray, counts), first));
    if (!first.found()) continue;
    meshes += first.part != no_part ? 1 : 0;
    shapes += world.instances().has_shape(first.instance) ? 1 : 0;
  }
  EXPECT_EQ(counts.exhausted, 0u);
  EXPECT_GT(meshes, 500);
  EXPECT_GT(shapes, 100);
}

TEST(MeshWorld, boxes_of_turned_meshes_are_tight_and_hold_their_vertices) {
  testing::Random random(7);
  const MeshPointer ring = testing::torus(24, 16).shared();
  double share = 0;
  constexpr int count = 50;
  for (int i = 0; i < count; ++i) {
    const PosedMesh posed(0, ring, random_pose(random, 100));
    const Bounds<double> tight = posed.tight_bounds_under(posed.pose), whole = posed.bounds();
    Bounds<double> exact;
    for (const Vec3<double>& vertex : ring->vertices()) exact.extend(posed.pose(vertex));
    constexpr double rounding = 1e-13;
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(tight.lower[k], exact.lower[k] + rounding);
      EXPECT_GE(tight.upper[k], exact.upper[k] - rounding);
      EXPECT_GE(tight.lower[k], whole.lower[k]);
      EXPECT_LE(tight.upper[k], whole.upper[k]);
    }
    share += (tight.half_extents().prod() - exact.half_extents().prod()) /
             (whole.half_extents().prod() - exact.half_extents().prod()) / count;
  }
  EXPECT_LT(share, 0.7);  // of the room around the mesh in its turned box
}

TEST(MeshWorld, a_block_of_triangles_is_met_where_the_box_is) {
  testing::Random random(3);
  const MeshPointer block = testing::block({0.3, 0.4, 0.5}).shared();
  for (int i = 0; i < 200; ++i) {
    const double far = i % 4 == 0 ? 1e6 : 1;
    Affine<double> pose = random_pose(random, far);
    Instances of_mesh, of_box;
    of_mesh.add(block, pose);
    of_box.add(Box{{0.3, 0.4, 0.5}}, pose);
    const World mesh(std::move(of_mesh)), box(std::move(of_box));
    for (int k = 0; k < 50; ++k) {
      const Vec3<double> from = pose.translation + 3 * random.direction();
      const Ray<double> ray{from, pose.translation + 0.6 * random.in_cube() - from};
      QueryCounts counts;
      const WorldHit at_mesh = mesh.closest_hit(ray, counts), at_box = box.closest_hit(ray, counts);
      ASSERT_EQ(at_mesh.found(), at_box.found()) << i;
      if (!at_mesh.found()) continue;
      // Both intervals hold the one true t, and so have it in common.
      const auto lo = [](const WorldHit& hit) { return hit.cast.t_base + hit.cast.offset_lo; };
      const auto hi = [](const WorldHit& hit) { return hit.cast.t_base + hit.cast.offset_hi; };
      const double rounding = 4e-16;
      ASSERT_LE(std::max(lo(at_mesh), lo(at_box)), std::min(hi(at_mesh), hi(at_box)) + rounding);
      ASSERT_LE(hi(at_mesh) - lo(at_mesh), 1e-9 * far);
      ASSERT_NEAR((at_mesh.cast.normal - at_box.cast.normal).norm(), 0, 1e-12);
    }
  }
}

TEST(MeshWorld, a_ray_that_leaves_a_mesh_meets_what_is_beyond_and_not_where_it_begins) {
  Instances instances;
  instances.add(testing::torus(60, 40).shared(), {});
  const World world(std::move(instances));
  testing::Random random(4);
  int again = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3<double> from = 3 * random.direction();
    const Ray<double> ray{from, 1.3 * random.in_cube() - from};
    QueryCounts counts;
    const WorldHit hit = world.closest_hit(ray, counts);
    if (!hit.found()) continue;
    Vec3<double> out = random.direction();
    if (out.dot(hit.cast.normal) < 0) out = -out;
    if (out.dot(hit.cast.normal) < 1e-3) continue;
    const WorldHit next = world.closest_hit({ray.at(hit.cast.t()), out}, counts, 0);
    if (!next.found()) continue;
    ASSERT_GT(next.cast.t(), 1e-4);
    ASSERT_NE(next.part, hit.part);
    ++again;
  }
  EXPECT_GT(again, 300);
}

TEST(MeshWorld, is_shown_to_some_rays_only_and_moves) {
  Instances instances;
  instances.add(testing::block({1, 1, 1}).shared(), {});
  instances.add(Sphere{0.5}, shifted_by(0, 0, 5));
  instances.show_to(0, 2);
  World world(std::move(instances));
  QueryCounts counts;
  WorldRay ray{{{0, 0, -9}, {0, 0, 1}}};
  EXPECT_EQ(world.closest_hit(ray, counts).instance, 0u);
  ray.kinds = 1;
  EXPECT_EQ(world.closest_hit(ray, counts).instance, 1u);
  EXPECT_TRUE(world.occluded(ray, counts));
  ray.kinds = 2;
  world.set_pose(0, shifted_by(3, 0, 0));
  const auto pose_of = [&](std::size_t i) { return *world.instances().plain_pose(i); };
  world.pose_all(pose_of);
  EXPECT_EQ(world.closest_hit(ray, counts).instance, 1u);
  ray.ray.origin.x() = 3;
  EXPECT_EQ(world.closest_hit(ray, counts).cast.t(), 8);
  // A shutter: the block goes by two while time goes from 0 to 1.
  world.pose_all(pose_of, [](std::size_t i) {
    Movement<double> movement;
    if (i == 0) movement.shift = {0, 0, 2};
    return movement;
  });
  ray.time = 0.5;
  EXPECT_EQ(world.closest_hit(ray, counts).cast.t(), 9);
}

/// Meshes alone, at sizes from thousandths to tens, some of them moving.
World world_of_meshes(std::uint64_t seed, int count, bool moves) {
  testing::Random random(seed);
  const MeshPointer ball = testing::bumpy_ball(20, 24).shared(),
                    ring = testing::torus(24, 16).shared();
  std::vector<Affine<double>> poses;
  for (int i = 0; i < count; ++i) {
    poses.push_back(random_pose(random, 5));
    if (i % 4 != 0) poses.back().linear *= std::exp2(random.uniform(-9, 3) * (i % 2 + 1) / 2);
  }
  Instances instances;
  for (int i = 0; i < count; ++i) instances.add(i % 3 == 0 ? ball : ring, poses[std::size_t(i)]);
  instances.show_to(static_cast<std::size_t>(count) / 2, 2);
  World world(std::move(instances));
  if (moves)
    world.pose_all([&](std::size_t i) { return poses[i]; },
                   [](std::size_t i) {
                     Movement<double> movement;
                     if (i % 5 == 0) movement.shift = {0.3, -0.2, 0.1};
                     return movement;
                   });
  return world;
}

TEST(MeshWorld, rays_together_get_what_single_rays_get) {
  for (const int count : {1, 2, 7, 60})
    for (const bool moves : {false, true}) {
      const World world = world_of_meshes(static_cast<std::uint64_t>(count), count, moves);
      testing::Random random(8);
      std::vector<WorldRay> rays;
      const auto add = [&](const Ray<double>& ray) {
        WorldRay one{ray};
        one.time = moves ? random.uniform(0, 1) : 0;
        one.kinds = rays.size() % 7 == 0 ? 1 : all_ray_kinds;
        if (rays.size() % 11 == 0)
          one.skip = static_cast<std::uint32_t>(rays.size() % world.instances().size());
        rays.push_back(one);
      };
      // Blocks from four points, some within a mesh, with directions of several lengths.
      for (int block = 0; block < 24; ++block) {
        const Vec3<double> from = block % 4 == 0 ? Vec3<double>(0, 0, 0) : 9 * random.direction();
        const Vec3<double> towards = (random.in_cube() - from).normalized();
        const double length = std::exp2(random.uniform(-20, 20));
        for (int k = 0; k < 64; ++k) {
          const Vec3<double> d = length * (towards + 0.1 * random.in_cube());
          add({from, d});
          if (k % 9 == 0) rays.back().ray.t_max = 8 / length;
        }
      }
      for (int i = 0; i < 1500; ++i) add(random_ray(random));
      add({{0, 0, 0}, {0, 0, 0}});
      add({{0, 0, 1e305}, {0, 0, -1}});
      SCOPED_TRACE(count);
      testing::Compared compared;
      compared.with_single_rays(world, rays);
      EXPECT_EQ(compared.together.exhausted, compared.alone.exhausted);
      EXPECT_GT(compared.hits, 20u);
    }
}

TEST(MeshWorld, answers_rays_that_have_no_direction_or_too_large_numbers) {
  Instances instances;
  instances.add(testing::block({1, 1, 1}).shared(), {});
  const World world(std::move(instances));
  QueryCounts counts;
  EXPECT_FALSE(world.closest_hit({{0, 0, 0}, {0, 0, 0}}, counts).found());
  EXPECT_EQ(counts.exhausted, 0u);
  EXPECT_EQ(world.closest_hit({{0, 0, 1e-3}, {0, 0, 1e-300}}, counts).cast.t(), 0.999e300);
  EXPECT_EQ(world.closest_hit({{0, 0, -9}, {0, 0, 1e250}}, counts).cast.t(), 8e-250);
  EXPECT_FALSE(world.closest_hit({{0, 0, 1e305}, {0, 0, -1}}, counts).found());
  EXPECT_EQ(counts.exhausted, 1u);
  // Here t would be more than the largest double.
  EXPECT_FALSE(world.closest_hit({{0, 0, 2}, {0, 0, -1e-320}}, counts).found());
  EXPECT_EQ(counts.exhausted, 2u);
}

}  // namespace
}  // namespace minkray
