// SPDX-License-Identifier: MIT
#include "renderer/film/render.h"

#include <gtest/gtest.h>

#include <atomic>

#include "core/parallel/parallel.h"
#include "renderer/audit/ray_audit.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

/// A few shapes on a glossy floor, every kind of light.
Scene still_life() {
  Scene scene;
  scene.camera.position = {3, -7, 4};
  scene.camera.look_at = {0, 0, 0.6};
  scene.camera.fov_y_degrees = 35;
  scene.lights = {DirectionalLight{{-1, 1, -2}, {2, 1.9, 1.7}}, PointLight{{1, -3, 4}, {9, 9, 9}},
                  EnvironmentLight{{0.7, 0.8, 1.0}, {0.3, 0.3, 0.3}}};
  scene.materials = {{"floor", GlossyMaterial{Colour::Constant(0.5), 0.1, 1.5}},
                     {"red", GlossyMaterial{{0.8, 0.2, 0.1}, 0.0, 1.5}},
                     {"blue", LambertMaterial{{0.1, 0.3, 0.8}}}};
  const Shape box(Box{{0.5, 0.4, 0.3}});
  scene.objects = {{"floor", Box{{50, 50, 1}}, shifted_by(0, 0, -1), 0},
                   {"ball", Sphere{0.8}, shifted_by(-1.2, 0, 0.8), 1},
                   {"rounded box", Rounded{0.2, box}, shifted_by(0.8, 0, 0.5), 2}};
  return scene;
}

RenderOptions small_picture() {
  RenderOptions options;
  options.resolution = {75, 50};
  options.samples = 3;
  options.seed = 9;
  return options;
}

TEST(Render, the_same_bits_for_any_number_of_threads) {
  const Scene scene = still_life();
  const World world = make_world(scene);
  Image first;
  for (const int threads : {1, 2, 3, 7}) {
    Rendering rendering;
    with_threads(threads, [&] { rendering = render(scene, world, small_picture()); });
    EXPECT_TRUE(rendering.complete);
    EXPECT_EQ(rendering.counts.work.exhausted, 0u);
    if (threads == 1) first = rendering.image;
    EXPECT_EQ(rendering.image.pixels, first.pixels) << threads;
  }
}

/// Turned boxes and others, as many as may be, that shade each other, in light of every kind.
Scene heap() {
  Scene scene = still_life();
  const Shape box(Box{{0.2, 0.15, 0.1}});
  const std::vector<Shape> kinds = {Rounded{0.05, box}, Sphere{0.25}, Cylinder{0.15, 0.2}, box};
  Sampler places(77, 0, 0, 0);
  for (std::size_t i = 0; i < 300; ++i) {
    const auto [a, b] = places.next();
    const auto [c, d] = places.next();
    scene.objects.push_back({"one of many",
                             kinds[i % kinds.size()],
                             {rotation_matrix(a, b, c, d), {6 * a - 3, 6 * b - 3, 1.5 * c}},
                             static_cast<std::uint32_t>(i % 3)});
  }
  return scene;
}

// Rays that are traced together must not know of each other.
TEST(Render, the_same_bits_for_any_ray_group) {
  const Scene scene = heap();
  const World world = make_world(scene), other_tree = make_world(scene, {}, BvhBuild::speed);
  for (const int samples : {1, 3, 70}) {
    RenderOptions options = small_picture();
    options.samples = samples;
    if (samples == 70) options.crop = {30, 20, 41, 27};
    options.integrator.ray_group = 1;
    const Rendering alone = render(scene, world, options);
    EXPECT_EQ(render(scene, other_tree, options).image.pixels, alone.image.pixels);
    for (const int group : {2, 4, 7, 8, 16, most_in_ray_group}) {
      options.integrator.ray_group = group;
      Rendering together;
      with_threads(1 + group % 3, [&] { together = render(scene, world, options); });
      EXPECT_EQ(together.image.pixels, alone.image.pixels) << group << " of " << samples;
      EXPECT_EQ(together.met, alone.met);
      EXPECT_EQ(together.counts.total(), alone.counts.total());
      EXPECT_EQ(together.counts.shadow, alone.counts.shadow);
      EXPECT_EQ(together.counts.background, alone.counts.background);
    }
  }
}

TEST(Render, shares_of_samples_do_not_depend_on_ray_groups) {
  const Scene scene = heap();
  const World world = make_world(scene);
  RenderOptions options = small_picture();
  options.crop = {30, 20, 50, 31};
  options.samples = 7;
  options.sample_share = {2, 3};
  options.integrator.ray_group = 1;
  const Rendering alone = render(scene, world, options);
  ASSERT_GT(alone.block_sums.size(), 1u);
  for (const int group : {4, 8}) {
    options.integrator.ray_group = group;
    const Rendering together = render(scene, world, options);
    ASSERT_EQ(together.block_sums.size(), alone.block_sums.size());
    for (std::size_t i = 0; i < alone.block_sums.size(); ++i)
      EXPECT_EQ(together.block_sums[i].pixels, alone.block_sums[i].pixels);
  }
}

// Every ray is proven, in groups or not.
TEST(Render, ray_groups_are_audited) {
  const Scene scene = still_life();
  const World world = make_world(scene);
  RenderOptions options = small_picture();
  options.crop = {20, 20, 31, 29};
  std::array<std::uint64_t, 4> rays_alone{};
  for (const int group : {1, 8}) {
    RayAudit audit(scene, world);
    options.integrator.ray_group = group;
    options.integrator.observer = &audit;
    render(scene, world, options);
    for (std::size_t kind = 0; kind < 4; ++kind) {
      EXPECT_EQ(audit.failed(static_cast<RayKind>(kind)), 0u);
      const std::uint64_t rays = audit.rays(static_cast<RayKind>(kind));
      if (group == 1) rays_alone[kind] = rays;
      EXPECT_EQ(rays, rays_alone[kind]) << ray_kind_names[kind];
      EXPECT_GT(rays, 0u) << ray_kind_names[kind];
    }
  }
}

TEST(Render, a_crop_is_a_part_of_the_whole_picture) {
  const Scene scene = still_life();
  const World world = make_world(scene);
  RenderOptions options = small_picture();
  const Image whole = render(scene, world, options).image;
  options.crop = {13, 7, 60, 41};
  const Image region = render(scene, world, options).image;
  ASSERT_EQ(region.width, 47);
  ASSERT_EQ(region.height, 34);
  for (int y = 0; y < region.height; ++y)
    for (int x = 0; x < region.width; ++x) EXPECT_EQ(region.at(x, y), whole.at(x + 13, y + 7));
}

TEST(Render, another_seed_gives_another_picture_of_the_same_thing) {
  const Scene scene = still_life();
  const World world = make_world(scene);
  RenderOptions options = small_picture();
  options.samples = 16;
  const Image one = render(scene, world, options).image;
  options.seed = 10;
  const Image other = render(scene, world, options).image;
  EXPECT_NE(one.pixels, other.pixels);
  const auto mean = [](const Image& image) {
    Vec3<float> sum = Vec3<float>::Zero();
    for (const Vec3<float>& pixel : image.pixels) sum += pixel;
    return Vec3<float>(sum / static_cast<float>(image.pixels.size()));
  };
  EXPECT_LT((mean(one) - mean(other)).norm(), 0.005f * mean(one).norm());
}

TEST(Render, stops_when_told_to) {
  const Scene scene = still_life();
  const World world = make_world(scene);
  RenderOptions options = small_picture();
  options.samples = 1 << 24;  // minutes for one pixel
  std::atomic<int> asked = 0;
  const Rendering rendering = render(scene, world, options, {{}, [&] { return ++asked > 1000; }});
  EXPECT_FALSE(rendering.complete);
  EXPECT_LE(rendering.counts.camera, 1000u);
}

TEST(Render, tells_how_far_it_is) {
  const Scene scene = still_life();
  const World world = make_world(scene);
  double last = 0;
  const auto progress = [&](double fraction, std::uint64_t rays) {
    EXPECT_GT(fraction, last);
    EXPECT_GT(rays, 0u);
    last = fraction;
  };
  EXPECT_TRUE(render(scene, world, small_picture(), {progress, {}}).complete);
  EXPECT_EQ(last, 1);
}

}  // namespace
}  // namespace minkray
