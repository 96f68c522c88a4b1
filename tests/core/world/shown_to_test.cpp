// SPDX-License-Identifier: MIT
// Rays meet what is shown to their kinds, and go through the rest: as if it were not there.
#include <set>

#include "tests/support/scattered_world.h"

namespace minkray {
namespace {

using namespace testing;

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

  Compared compared;
  compared.with_single_rays(world, rays);
  for (std::size_t begin = 0; begin < rays.size(); begin += 16)
    compared.with_single_rays(world, std::span<const WorldRay>(rays).subspan(
                                         begin, std::min<std::size_t>(16, rays.size() - begin)));
  QueryCounts counts;
  std::set<bool> met_half_space;
  for (const WorldRay& ray : rays) {
    for (std::size_t i = 0; i < shown_to.size(); ++i)
      ASSERT_EQ(world.instances().is_shown_to(i, ray.kinds), (shown_to[i] & ray.kinds) != 0);
    const WorldHit expected = first_of_all(world, ray);
    ASSERT_TRUE(same(world.closest_hit(ray, counts), expected));
    if (ray.kinds == 2 || ray.kinds == 4)
      met_half_space.insert(expected.instance + 1 == world.instances().size());
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
