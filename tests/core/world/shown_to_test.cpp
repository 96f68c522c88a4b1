// SPDX-License-Identifier: MIT
// Rays meet what is shown to their kinds, and go through the rest: as if it were not there.
#include <set>

#include "tests/support/scattered_world.h"

namespace minkray {
namespace {

using namespace testing;

/// One instance after the other, without a hierarchy.
WorldHit first_of_all(const World& world, const WorldRay& ray,
                      const std::vector<RayKinds>& shown_to) {
  const Instances& instances = world.instances();
  WorldHit first;
  first.cast.status = Status::miss;
  for (std::uint32_t i = 0; i < instances.size(); ++i) {
    if (i == ray.skip || (shown_to[i] & ray.kinds) == 0) continue;
    const CastResult<double> cast = instances.is_half_space(i)
                                        ? cast_ray(instances.half_spaces()[0].in_world, ray.ray)
                                        : cast_ray(instances.at(i), ray.ray);
    if (cast.found() && first.yields_to(i, cast.t())) first = {i, cast};
  }
  return first;
}

TEST(ShownTo, rays_meet_what_is_shown_to_one_of_their_kinds) {
  Scatter random;
  Instances shapes = scattered_instances(400, random);
  shapes.add(HalfSpaceBody<double>{Vec3<double>(0, 0, 1), -9});
  std::vector<RayKinds> shown_to;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    shown_to.push_back(static_cast<RayKinds>(1 + i % 7));
  shown_to.back() = 2;  // the half-space
  for (std::size_t i = 0; i < shapes.size(); ++i) shapes.show_to(i, shown_to[i]);
  const World world(std::move(shapes));
  std::vector<WorldRay> rays;
  for (int kind = 0; rays.size() < 3000; kind = (kind + 1) % 3)
    for (const WorldRay& ray : bundle(random, kind, 16, world.instances().size()))
      rays.push_back(ray);
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].kinds = static_cast<RayKinds>(1 + i % 7);

  QueryCounts counts;
  std::vector<WorldHit> streamed(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  world.closest_hits(rays, streamed, counts);
  world.occluded(rays, blocked, counts);
  std::set<bool> met_half_space;
  for (std::size_t begin = 0; begin < rays.size(); begin += 16) {
    const auto group = std::span<const WorldRay>(rays).subspan(
        begin, std::min<std::size_t>(16, rays.size() - begin));
    std::array<WorldHit, 16> together;
    world.closest_hits(group, std::span(together).first(group.size()), counts);
    std::array<std::uint8_t, 16> met;
    world.occluded(group, std::span(met).first(group.size()), counts);
    for (std::size_t k = 0; k < group.size(); ++k) {
      const WorldHit expected = first_of_all(world, group[k], shown_to);
      ASSERT_TRUE(same(world.closest_hit(group[k], counts), expected)) << begin + k;
      ASSERT_TRUE(same(together[k], expected)) << begin + k;
      ASSERT_TRUE(same(streamed[begin + k], expected)) << begin + k;
      EXPECT_EQ(world.occluded(group[k], counts), expected.found());
      EXPECT_EQ(met[k] != 0, expected.found());
      EXPECT_EQ(blocked[begin + k] != 0, expected.found());
      if (group[k].kinds == 2 || group[k].kinds == 4)
        met_half_space.insert(expected.instance + 1 == world.instances().size());
    }
  }
  EXPECT_EQ(met_half_space.size(), 2u);
}

TEST(ShownTo, all_rays_meet_all_unless_it_is_said) {
  Scatter random;
  Instances shapes = scattered_instances(10, random);
  for (const RayKinds kinds : {RayKinds(1), RayKinds(128), all_ray_kinds})
    EXPECT_TRUE(shapes.is_shown_to(3, kinds));
  shapes.show_to(3, 2);
  EXPECT_FALSE(shapes.is_shown_to(3, 1));
  EXPECT_TRUE(shapes.is_shown_to(3, 6));
  EXPECT_TRUE(shapes.is_shown_to(4, 1));
}

}  // namespace
}  // namespace minkray
