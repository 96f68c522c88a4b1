// SPDX-License-Identifier: MIT
// Rays in streams get the results that they get alone, bit for bit, for any division into streams
// and in any order.
#include "tests/support/scattered_world.h"

namespace minkray {
namespace {

using namespace testing;

std::vector<WorldRay> mixed_rays(Scatter& random, std::size_t count, std::size_t instances) {
  std::vector<WorldRay> rays;
  for (int kind = 0; rays.size() < count; kind = (kind + 1) % 3)
    for (const WorldRay& ray : bundle(random, kind, 16, instances)) rays.push_back(ray);
  rays.resize(count);
  return rays;
}

void expect_answers_of_single_rays(const World& world, std::span<const WorldRay> rays,
                                   std::size_t at_once) {
  std::size_t hits = 0;
  QueryCounts alone, in_stream;
  for (std::size_t begin = 0; begin < rays.size(); begin += at_once) {
    const auto asked = rays.subspan(begin, std::min(at_once, rays.size() - begin));
    std::vector<WorldHit> answers(asked.size());
    std::vector<std::uint8_t> met(asked.size());
    world.closest_hits(asked, answers, in_stream);
    world.occluded(asked, met, in_stream);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const WorldRay& ray = asked[i];
      const WorldHit hit = world.closest_hit(ray.ray, alone, ray.skip, ray.time);
      ASSERT_TRUE(same(answers[i], hit)) << "ray " << begin + i << ", " << at_once << " at once";
      ASSERT_EQ(met[i] != 0, hit.found()) << "ray " << begin + i;
      hits += hit.found() ? 1 : 0;
    }
  }
  EXPECT_GT(hits, rays.size() / 5);
  EXPECT_LT(hits, rays.size());
  EXPECT_EQ(in_stream.exhausted, 2 * alone.exhausted);
}

TEST(WorldManyRays, a_million_rays_at_all_kinds_of_shapes) {
  Scatter random;
  const World world(scattered_instances(3000, random));
  const auto rays = mixed_rays(random, 1000000, world.instances().size());
  expect_answers_of_single_rays(world, rays, 5000);
}

TEST(WorldManyRays, any_cut_and_order_gives_the_same) {
  Scatter random;
  const World world(scattered_instances(500, random));
  auto rays = mixed_rays(random, 3000, world.instances().size());
  for (const std::size_t at_once : {1u, 3u, 31u, 32u, 33u, 100u, 1024u, 1025u, 3000u})
    expect_answers_of_single_rays(world, rays, at_once);
  std::reverse(rays.begin(), rays.end());
  expect_answers_of_single_rays(world, rays, 3000);
}

TEST(WorldManyRays, a_shape_for_each_instance) {
  Scatter random;
  const World world(scattered_shapes(300, random));
  const auto rays = mixed_rays(random, 3000, world.instances().size());
  for (const std::size_t at_once : {10u, 3000u})
    expect_answers_of_single_rays(world, rays, at_once);
}

TEST(WorldManyRays, half_spaces_and_instances_on_the_move) {
  Scatter random;
  Instances shapes = scattered_instances(300, random);
  shapes.add(HalfSpaceBody<double>{Vec3<double>(0, 0, 1), -9});
  std::vector<Affine<double>> poses;
  std::vector<Movement<double>> movements;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    poses.push_back(shapes.is_half_space(i) ? Affine<double>() : random.pose(12));
    Movement<double>& movement = movements.emplace_back();
    movement.shift = random.point(2);
    if (i % 3 == 0) continue;  // goes without turning
    movement.angle = random.within(0, 3);
    movement.axis = unit<double>(random.point(1));
    movement.pivot = random.point(12);
  }
  World world(std::move(shapes));
  world.pose_all([&](std::size_t i) { return poses[i]; },
                 [&](std::size_t i) { return movements[i]; });
  auto rays = mixed_rays(random, 3000, world.instances().size());
  for (WorldRay& ray : rays) ray.time = random.within(0, 1);
  expect_answers_of_single_rays(world, rays, 3000);
}

TEST(WorldManyRays, other_solvers_find_what_they_find_alone) {
  Scatter random;
  CastOptions impatient;
  impatient.solver = SolverKind::paper;
  impatient.max_iterations = 3;
  const World world(scattered_instances(200, random), impatient);
  const auto rays = mixed_rays(random, 500, world.instances().size());
  std::vector<WorldHit> answers(rays.size());
  QueryCounts alone, in_stream;
  world.closest_hits(rays, answers, in_stream);
  for (std::size_t i = 0; i < rays.size(); ++i)
    ASSERT_TRUE(same(answers[i], world.closest_hit(rays[i].ray, alone, rays[i].skip)));
  EXPECT_GT(in_stream.exhausted, 0u);
}

TEST(WorldManyRays, no_rays_and_no_world) {
  const World empty;
  QueryCounts counts;
  empty.closest_hits({}, {}, counts);
  Scatter random;
  const auto rays = mixed_rays(random, 40, 1);
  std::vector<WorldHit> answers(rays.size());
  std::vector<std::uint8_t> met(rays.size(), 1);
  empty.closest_hits(rays, answers, counts);
  empty.occluded(rays, met, counts);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(answers[i].cast.status, Status::miss);
    EXPECT_FALSE(answers[i].found());
    EXPECT_EQ(met[i], 0);
  }
  EXPECT_EQ(counts.nodes, 0u);
}

}  // namespace
}  // namespace minkray
