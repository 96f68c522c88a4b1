// SPDX-License-Identifier: MIT
// Skies from pictures and the sky of a day: drawn where they are bright, with the density they
// claim.
#include <gtest/gtest.h>

#include "renderer/film/render.h"
#include "renderer/lights/sky_image.h"
#include "renderer/lights/sun_sky.h"
#include "renderer/paths/integrator.h"
#include "renderer/surfaces/reflection.h"
#include "tests/support/density.h"
#include "tests/support/must_hold.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

/// Dim, with a bright patch near the horizon and one at the top.
std::shared_ptr<const Image> patches() {
  auto image = std::make_shared<Image>(64, 32, Vec3<float>::Constant(0.1F));
  for (int y = 12; y < 16; ++y)
    for (int x = 40; x < 46; ++x) image->at(x, y) = {20, 15, 5};
  for (int x = 0; x < 64; ++x) image->at(x, 0) = {3, 3, 6};
  return image;
}

TEST(SkyImage, directions_have_the_density_they_claim) {
  const SkyImage sky(patches(), 2, 0.7);
  const auto draw = [&](Sampler& sampler) -> std::optional<Vec3<double>> {
    const auto sample = sky.sample({0, 0, 0}, sampler);
    return sample ? std::optional(sample->direction) : std::nullopt;
  };
  const auto pdf = [&](const Vec3<double>& w) { return sky.pdf({0, 0, 0}, w); };
  const DensityCheck check = check_density(draw, pdf);
  // The edges of bright pixels fall between the lines of the grid that sums the density up: its
  // step is 1/768 of a turn, and the bright patch is 72 of them wide.
  EXPECT_NEAR(check.total, 1, 1.0 / 72);
  EXPECT_NEAR(check.drawn, 1, 1e-12);
  EXPECT_LT(check.largest_excess, 6);
  EXPECT_GT(check.cells, 50);
}

TEST(SkyImage, its_middle_is_towards_y_and_it_turns_against_the_clock) {
  auto image = std::make_shared<Image>(64, 32);
  // A quarter of a turn to the right of the middle, at the horizon.
  for (int y = 14; y < 18; ++y)
    for (int x = 46; x < 50; ++x) image->at(x, y) = {1, 1, 1};
  EXPECT_NEAR(SkyImage(image, 3, 0).eval({1, 0, 0}).x(), 3, 1e-6);
  EXPECT_NEAR(SkyImage(image, 3, 0).eval({0, 1, 0}).x(), 0, 1e-6);
  EXPECT_NEAR(SkyImage(image, 3, std::numbers::pi / 2).eval({0, 1, 0}).x(), 3, 1e-6);
}

/// Radiance from the middle of a matt floor, by `samples` samples, and its variance.
std::pair<double, double> floor_under(const Scene& scene, int samples, std::uint64_t seed) {
  const World world = make_world(scene);
  const Integrator integrator(scene, world, {.kind = IntegratorKind::path, .max_depth = 1});
  RayCounts counts;
  double sum = 0, squares = 0;
  for (int i = 0; i < samples; ++i) {
    TracedRay ray{{{-1, 0, 1}, unit<double>({1, 0, -1})},
                  Sampler(seed, 0, 0, static_cast<std::uint32_t>(i))};
    integrator.trace(std::span(&ray, 1), counts);
    sum += ray.radiance.x() / samples;
    squares += ray.radiance.x() * ray.radiance.x() / samples;
  }
  return {sum, squares - sum * sum};
}

Scene floor_scene(const Light& light) {
  Scene scene;
  scene.materials = {{"white", LambertMaterial{Colour::Ones()}}};
  scene.objects = {{"floor", Box{{5, 5, 1}}, shifted_by(0, 0, -1), 0}};
  scene.lights = {light};
  return scene;
}

// A sun of 1000 times the mean: at 64 samples at most a quarter of the error of cosine sampling.
TEST(SkyImage, a_small_sun_is_found) {
  auto image = std::make_shared<Image>(256, 128, Vec3<float>::Constant(1));
  double above = 0;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 256; ++x) {
      const double z0 = std::cos(std::numbers::pi * y / 128);
      const double z1 = std::cos(std::numbers::pi * (y + 1) / 128);
      if (x >= 100 && x < 104 && y >= 30 && y < 32) image->at(x, y).setConstant(1000);
      if (y < 64)
        above += image->at(x, y).x() * (z0 * z0 - z1 * z1) / 2 * 2 * std::numbers::pi / 256;
    }
  const Scene scene = floor_scene(ImageSkyLight{{"sky", image}});
  const double expected = above / std::numbers::pi;
  EXPECT_NEAR(floor_under(scene, 1 << 16, 1).first / expected, 1, 0.01);

  const SkyImage sky(image, 1, 0);
  double error = 0, of_cosine = 0;
  for (std::uint64_t seed = 0; seed < 64; ++seed) {
    error += std::pow(floor_under(scene, 64, seed).first - expected, 2) / 64;
    double by_cosine = 0;
    for (std::uint32_t i = 0; i < 64; ++i)
      by_cosine += sky.eval(cosine_direction(Sampler(seed, 1, 0, i).next())).x() / 64;
    of_cosine += std::pow(by_cosine - expected, 2) / 64;
  }
  EXPECT_LT(std::sqrt(error), std::sqrt(of_cosine) / 4);
  tell_figure("error_under_a_small_sun_beside_cosine_sampling", std::sqrt(error / of_cosine),
              "<= 0.25");
}

TEST(SunSky, noon_is_brighter_and_whiter_than_evening) {
  SunSkyLight noon{{0, 0.3, 1}}, evening{{0, 1, 0.05}};
  const auto sun = [](const SunSkyLight& light) {
    return SunDisk(light).eval(unit<double>(light.sun));
  };
  EXPECT_GT(sun(noon).x(), 2 * sun(evening).x());
  EXPECT_GT(sun(evening).x() / sun(evening).z(), 2 * sun(noon).x() / sun(noon).z());
  // Away from the sun a clear sky is blue.
  const SkyImage sky(sky_of(noon), 1, 0);
  const Colour blue = sky.eval(unit<double>({0, -1, 0.7}));
  EXPECT_GT(blue.z(), 1.3 * blue.x());
  EXPECT_EQ(sky.eval({0, 0, -1}), (noon.ground.cast<float>().cast<double>()));
}

// A horizontal surface gets about 100 klx at noon, about a fifth of it from the sky.
TEST(SunSky, the_sun_at_noon_lights_the_ground_with_about_100_klx) {
  const Scene scene = floor_scene(SunSkyLight{{0, 0.2, 1}});
  const double klx = floor_under(scene, 1 << 12, 3).first * std::numbers::pi * 10;
  EXPECT_GT(klx, 80);
  EXPECT_LT(klx, 150);
}

TEST(SunDisk, directions_lie_in_it) {
  const SunSkyLight light{{0.3, 0.2, 0.8}};
  const SunDisk sun(light);
  int within = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    Sampler sampler(1, 0, 0, i);
    const auto sample = sun.sample({0, 0, 0}, sampler);
    ASSERT_TRUE(sample);
    EXPECT_NEAR(sample->direction.norm(), 1, 1e-12);
    within += sun.pdf({0, 0, 0}, sample->direction) > 0 ? 1 : 0;
    EXPECT_LT(std::acos(std::min(sample->direction.dot(unit<double>(light.sun)), 1.0)),
              0.2666 * std::numbers::pi / 180);
  }
  EXPECT_GE(within, 999);
}

}  // namespace
}  // namespace minkray
