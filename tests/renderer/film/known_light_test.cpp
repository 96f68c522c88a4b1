// SPDX-License-Identifier: MIT
// Surfaces whose light is known: in closed form, in the furnace, in shadows.
#include <gtest/gtest.h>

#include <numbers>

#include "renderer/film/render.h"
#include "renderer/rays/camera.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

/// A solver that ends when the gap |v| is within rounding finds the normal to the square root of
/// it.
constexpr double normal_error = 4e-8;

/// The radiance of the ray through a point of the picture, many samples.
Colour radiance(const Scene& scene, double x, double y, int samples = 1,
                const IntegratorOptions& options = {}) {
  const World world = make_world(scene);
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
  scene.objects = {{"ball", Sphere{1}, {}, 0}};
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
  scene.objects.push_back({"shade", Disk{0.5}, shifted_by(0, -1, 3), 0});
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
  scene.objects = {{"a", Box{{3, 3, 0.3}}, tilted({0, 0, -0.3}), 0},
                   {"b", Box{{1, 1, 0.7}}, tilted({0.5, 0, -0.7}), 0},
                   {"c", Box{{1, 1, 0.7}}, tilted({0.5, 0, -0.7}), 0}};
  const Vec3<double> up = turned.col(2);
  scene.lights = {DirectionalLight{-up, Colour::Constant(std::numbers::pi)}};
  int seen = 0;
  for (int y = 40; y < 60; ++y)
    for (int x = 40; x < 60; ++x, ++seen)
      EXPECT_NEAR(radiance(scene, x + 0.37, y + 0.71).x(), 1, 1e-9) << x << " " << y;
  scene.lights = {EnvironmentLight{Colour::Ones(), Colour::Ones()}};
  EXPECT_NEAR(radiance(scene, 50, 50, 256).x(), 1, 1e-9);
}

// The furnace: in even light from everywhere, a white surface of any gloss is indistinguishable
// from it. Nothing may be gained or lost.
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
  scene.objects = {{"floor", Box{{1e4, 1e4, 1}}, shifted_by(0, 0, -1), 0},
                   {"wall", Box{{1, 1e4, 1e4}}, shifted_by(1, 0, 0), 0}};
  scene.lights = {EnvironmentLight{Colour::Ones(), Colour::Ones()}};
  EXPECT_NEAR(radiance(scene, 50, 50, 4096, {.bounces = 0}).x(), 0.5, 2e-3);
}

}  // namespace
}  // namespace minkray
