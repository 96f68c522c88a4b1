// SPDX-License-Identifier: MIT
#include "renderer/film/render.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numbers>

#include "core/parallel/parallel.h"
#include "renderer/audit/ray_audit.h"
#include "renderer/light/camera.h"

namespace minkray {
namespace {

Affine<double> at(double x, double y, double z) {
  return {Mat3<double>::Identity(), {x, y, z}};
}

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
  const Shape<double> box(Box<double>{{0.5, 0.4, 0.3}});
  scene.objects = {{"floor", Box<double>{{50, 50, 1}}, at(0, 0, -1), 0},
                   {"ball", Sphere<double>{0.8}, at(-1.2, 0, 0.8), 1},
                   {"rounded box", Rounded<double>{0.2, box}, at(0.8, 0, 0.5), 2}};
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
  const RenderWorld world = make_world(scene);
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
  const Shape<double> box(Box<double>{{0.2, 0.15, 0.1}});
  const std::vector<Shape<double>> kinds = {Rounded<double>{0.05, box}, Sphere<double>{0.25},
                                            Cylinder<double>{0.15, 0.2}, box};
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
TEST(Render, the_same_bits_for_any_packet) {
  const Scene scene = heap();
  const RenderWorld world = make_world(scene), other_tree = make_world(scene, {}, BvhBuild::speed);
  for (const int samples : {1, 3, 70}) {
    RenderOptions options = small_picture();
    options.samples = samples;
    if (samples == 70) options.crop = {30, 20, 41, 27};
    options.integrator.packet = 1;
    const Rendering alone = render(scene, world, options);
    EXPECT_EQ(render(scene, other_tree, options).image.pixels, alone.image.pixels);
    for (const int packet : {2, 4, 7, 8, 16, most_in_packet}) {
      options.integrator.packet = packet;
      Rendering together;
      with_threads(1 + packet % 3, [&] { together = render(scene, world, options); });
      EXPECT_EQ(together.image.pixels, alone.image.pixels) << packet << " of " << samples;
      EXPECT_EQ(together.met, alone.met);
      EXPECT_EQ(together.counts.total(), alone.counts.total());
      EXPECT_EQ(together.counts.shadow, alone.counts.shadow);
      EXPECT_EQ(together.counts.background, alone.counts.background);
      EXPECT_LT(together.counts.work.nodes, alone.counts.work.nodes);
    }
  }
}

TEST(Render, shares_of_samples_do_not_depend_on_packets) {
  const Scene scene = heap();
  const RenderWorld world = make_world(scene);
  RenderOptions options = small_picture();
  options.crop = {30, 20, 50, 31};
  options.samples = 7;
  options.sample_share = {2, 3};
  options.integrator.packet = 1;
  const Rendering alone = render(scene, world, options);
  ASSERT_GT(alone.block_sums.size(), 1u);
  for (const int packet : {4, 8}) {
    options.integrator.packet = packet;
    const Rendering together = render(scene, world, options);
    ASSERT_EQ(together.block_sums.size(), alone.block_sums.size());
    for (std::size_t i = 0; i < alone.block_sums.size(); ++i)
      EXPECT_EQ(together.block_sums[i].pixels, alone.block_sums[i].pixels);
  }
}

// Proof is asked for every ray, in packets or not.
TEST(Render, packets_are_audited) {
  const Scene scene = still_life();
  const RenderWorld world = make_world(scene);
  RenderOptions options = small_picture();
  options.crop = {20, 20, 31, 29};
  std::array<std::uint64_t, 4> rays_alone{};
  for (const int packet : {1, 8}) {
    RayAudit audit(scene, world);
    options.integrator.packet = packet;
    options.integrator.observer = &audit;
    render(scene, world, options);
    for (std::size_t kind = 0; kind < 4; ++kind) {
      EXPECT_EQ(audit.failed(static_cast<RayKind>(kind)), 0u);
      const std::uint64_t rays = audit.rays(static_cast<RayKind>(kind));
      if (packet == 1) rays_alone[kind] = rays;
      EXPECT_EQ(rays, rays_alone[kind]) << ray_kind_names[kind];
      EXPECT_GT(rays, 0u) << ray_kind_names[kind];
    }
  }
}

TEST(Render, a_crop_is_a_part_of_the_whole_picture) {
  const Scene scene = still_life();
  const RenderWorld world = make_world(scene);
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
  const RenderWorld world = make_world(scene);
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
  const RenderWorld world = make_world(scene);
  RenderOptions options = small_picture();
  options.samples = 1 << 24;  // minutes for one pixel
  std::atomic<int> asked = 0;
  const Rendering rendering = render(scene, world, options, {{}, [&] { return ++asked > 1000; }});
  EXPECT_FALSE(rendering.complete);
  EXPECT_LE(rendering.counts.camera, 1000u);
}

TEST(Render, tells_how_far_it_is) {
  const Scene scene = still_life();
  const RenderWorld world = make_world(scene);
  double last = 0;
  const auto progress = [&](double fraction, std::uint64_t rays) {
    EXPECT_GT(fraction, last);
    EXPECT_GT(rays, 0u);
    last = fraction;
  };
  EXPECT_TRUE(render(scene, world, small_picture(), {progress, {}}).complete);
  EXPECT_EQ(last, 1);
}

/// A solver that ends when the gap |v| is within rounding knows the normal to the square root of
/// it.
constexpr double normal_error = 4e-8;

/// The radiance of the ray through a point of the picture, many samples.
Colour radiance(const Scene& scene, double x, double y, int samples = 1,
                const IntegratorOptions& options = {}) {
  const RenderWorld world = make_world(scene);
  const Integrator integrator(scene, world, options);
  const Camera camera(scene.camera, scene.camera.resolution);
  Colour sum = Colour::Zero();
  RayCounts counts;
  for (int i = 0; i < samples; ++i) {
    TracedRay ray{camera.ray(x, y), Sampler(3, 0, 0, static_cast<std::uint32_t>(i))};
    integrator.trace(std::span(&ray, 1), counts);
    sum += ray.radiance;
  }
  return sum / samples;
}

Scene one_ball(const Material& material) {
  Scene scene;
  scene.camera.position = {0, -5, 0};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.resolution = {100, 100};
  scene.background = {Colour::Zero(), Colour::Zero()};
  scene.materials = {material};
  scene.objects = {{"ball", Sphere<double>{1}, {}, 0}};
  return scene;
}

// Lambert's law on a ball, in closed form: radiance = colour / pi * irradiance * cosine, and none
// on the side that is turned away.
TEST(Integrator, a_matt_ball_in_the_sun) {
  Scene scene = one_ball({"matt", LambertMaterial{{0.9, 0.5, 0.1}}});
  const Vec3<double> to_sun = Vec3<double>(1, -1, 0.5).normalized();
  scene.lights = {DirectionalLight{-7.0 * to_sun, {2, 3, 4}}};
  const Camera camera(scene.camera, scene.camera.resolution);
  int lit = 0, dark = 0;
  for (int y = 0; y < 100; y += 3)
    for (int x = 0; x < 100; x += 3) {
      const Ray<double> ray = camera.ray(x, y);
      // The nearer root of |o + t d| = 1.
      const double b = ray.origin.dot(ray.direction), c = ray.origin.squaredNorm() - 1;
      const Colour seen = radiance(scene, x, y);
      if (b * b < c) {
        EXPECT_EQ(seen, Colour::Zero());
        continue;
      }
      const double cosine = ray.at(-b - std::sqrt(b * b - c)).dot(to_sun);
      (cosine > 0 ? lit : dark)++;
      const Colour expected =
          std::max(cosine, 0.0) / std::numbers::pi * Colour(0.9 * 2, 0.5 * 3, 0.1 * 4);
      EXPECT_NEAR((seen - expected).norm(), 0, normal_error);
    }
  EXPECT_GT(lit, 10);
  EXPECT_GT(dark, 10);
}

TEST(Integrator, a_point_light_fades_with_the_square_of_the_distance) {
  Scene scene = one_ball({"matt", LambertMaterial{Colour::Ones()}});
  for (const double distance : {0.5, 2.0, 3.0}) {
    scene.lights = {PointLight{{0, -1 - distance, 0}, Colour::Constant(5)}};
    // Rays towards the light begin 2e-13 above the surface.
    EXPECT_NEAR(radiance(scene, 50, 50).x() * distance * distance, 5 / std::numbers::pi, 1e-11);
  }
}

TEST(Integrator, shadows_fall_and_end_at_the_light) {
  Scene scene = one_ball({"matt", LambertMaterial{Colour::Ones()}});
  scene.objects.push_back({"shade", Disk<double>{0.5}, at(0, -1, 3), 0});
  scene.lights = {PointLight{{0, -1.2, 5}, Colour::Constant(5)}};
  const double y = 30;  // the ball's upper half
  EXPECT_EQ(radiance(scene, 50, y), Colour::Zero());
  scene.lights = {PointLight{{0, -1.2, 2.9}, Colour::Constant(5)}};
  EXPECT_GT(radiance(scene, 50, y).x(), 0.1);
}

// Two boxes with their tops in one plane, one of them standing in the other: rounding must not make
// them shade each other, in the sun or under an even sky.
TEST(Integrator, faces_in_one_plane_have_no_acne) {
  Scene scene = one_ball({"matt", LambertMaterial{Colour::Ones()}});
  scene.camera.position = {0.1, -5, 7};
  const Mat3<double> turned = rotation_matrix(0.1, 0.2, 0.3, 1.0);
  const auto tilted = [&](const Vec3<double>& centre) {
    return Affine<double>{turned, Vec3<double>(turned * centre)};
  };
  scene.objects = {{"a", Box<double>{{3, 3, 0.3}}, tilted({0, 0, -0.3}), 0},
                   {"b", Box<double>{{1, 1, 0.7}}, tilted({0.5, 0, -0.7}), 0},
                   {"c", Box<double>{{1, 1, 0.7}}, tilted({0.5, 0, -0.7}), 0}};
  const Vec3<double> up = turned.col(2);
  scene.lights = {DirectionalLight{-up, Colour::Constant(std::numbers::pi)}};
  int seen = 0;
  for (int y = 40; y < 60; ++y)
    for (int x = 40; x < 60; ++x, ++seen)
      EXPECT_NEAR(radiance(scene, x + 0.37, y + 0.71).x(), 1, 1e-9) << x << " " << y;
  scene.lights = {EnvironmentLight{Colour::Ones(), Colour::Ones()}};
  EXPECT_NEAR(radiance(scene, 50, 50, 256).x(), 1, 1e-9);
}

// The furnace: in even light from everywhere, a white surface of whatever gloss cannot be told from
// it. Nothing may be gained or lost.
TEST(Integrator, a_white_ball_vanishes_in_an_even_environment) {
  for (const Material& material :
       {Material{"matt", LambertMaterial{Colour::Ones()}},
        Material{"smooth coat", GlossyMaterial{Colour::Ones(), 0.0, 1.5}}}) {
    Scene scene = one_ball(material);
    scene.lights = {EnvironmentLight{Colour::Constant(0.5), Colour::Constant(0.5)}};
    for (const double x : {50.0, 60.0, 72.0})
      EXPECT_NEAR(radiance(scene, x, 50, 4096).x(), 0.5, 1e-3) << material.name << " " << x;
  }
}

TEST(Integrator, a_rough_coat_gains_nothing_in_the_furnace) {
  for (const double roughness : {0.2, 0.5, 1.0}) {
    Scene scene = one_ball({"rough", GlossyMaterial{Colour::Ones(), roughness, 1.5}});
    scene.lights = {EnvironmentLight{Colour::Ones(), Colour::Ones()}};
    for (const double x : {50.0, 60.0, 72.0}) {
      const double seen = radiance(scene, x, 50, 1024).x();
      EXPECT_LE(seen, 1.01) << roughness << " " << x;
      EXPECT_GE(seen, 0.85) << roughness << " " << x;
    }
  }
}

// A matt floor under half a sky: the box's wall hides the half of the hemisphere behind it.
TEST(Integrator, a_wall_hides_half_of_the_sky) {
  Scene scene = one_ball({"matt", LambertMaterial{Colour::Ones()}});
  scene.camera.position = {-3, 0, 4};
  scene.camera.look_at = {-1e-6, 0, 0};
  scene.objects = {{"floor", Box<double>{{1e4, 1e4, 1}}, at(0, 0, -1), 0},
                   {"wall", Box<double>{{1, 1e4, 1e4}}, at(1, 0, 0), 0}};
  scene.lights = {EnvironmentLight{Colour::Ones(), Colour::Ones()}};
  EXPECT_NEAR(radiance(scene, 50, 50, 4096, {.bounces = 0}).x(), 0.5, 2e-3);
}

}  // namespace
}  // namespace minkray
