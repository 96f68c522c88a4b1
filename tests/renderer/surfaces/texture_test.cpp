// SPDX-License-Identifier: MIT
#include "renderer/surfaces/texture.h"

#include <gtest/gtest.h>

#include "renderer/film/render.h"
#include "renderer/paths/integrator.h"
#include "renderer/surfaces/noise.h"

namespace minkray {
namespace {

template <class T>
T two_colours(const char* mapping = "") {
  T texture;
  texture.a = Colour::Ones();
  texture.b = Colour::Zero();
  texture.mapping.name = mapping;
  return texture;
}

double at(const TextureKind& texture, const Vec3<double>& position,
          const Vec3<double>& normal = {0, 0, 1}) {
  return paint_at(Paint(texture), {position, unit(normal)}).x();
}

TEST(Texture, fields_of_a_checkerboard_take_turns) {
  const auto board = two_colours<CheckerTexture>("planar");
  EXPECT_EQ(at(board, {0.5, 0.5, 0}), 1 - at(board, {1.5, 0.5, 0}));
  EXPECT_EQ(at(board, {0.5, 0.5, 0}), at(board, {1.5, 1.5, 7}));
  const auto cubes = two_colours<CheckerTexture>();
  EXPECT_EQ(at(cubes, {0.5, 0.5, 0.5}), 1 - at(cubes, {0.5, 0.5, 1.5}));
  // On a face between two layers the one below it counts, however the place is rounded.
  EXPECT_EQ(at(cubes, {0.5, 0.5, 1e-16}), at(cubes, {0.5, 0.5, -1e-16}));
}

TEST(Texture, a_gradient_goes_from_one_colour_to_the_other) {
  auto rise = two_colours<GradientTexture>();
  rise.scale = 4;
  rise.direction = {0, 3, 0};
  EXPECT_NEAR(at(rise, {5, -2, 1}), 1, 1e-5);
  EXPECT_NEAR(at(rise, {5, 0, 1}), 0.5, 1e-5);
  EXPECT_NEAR(at(rise, {5, 1, 1}), 0.25, 1e-5);
  EXPECT_EQ(at(rise, {5, 9, 1}), 0);
}

TEST(Texture, radial_pictures_do_not_depend_on_the_distance_and_normal_ones_on_the_place) {
  auto image = std::make_shared<Image>(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) image->at(x, y).setConstant(static_cast<float>(y) / 31.0F);
  const ImageTexture radial{{"x", image}, {"radial"}, 1};
  const Vec3<double> p(0.3, -0.4, 0.5);
  EXPECT_NEAR(at(radial, p), at(radial, 7 * p), 1e-12);
  EXPECT_LT(at(radial, {0.1, 0, 1}), at(radial, {1, 0, 0.1}));  // rows count from the top
  const ImageTexture normal{{"x", image}, {"normal"}, 1};
  EXPECT_EQ(at(normal, p, {0, 1, 1}), at(normal, -p, {0, 1, 1}));
}

TEST(Texture, noise_is_smooth_and_has_no_trend) {
  double sum = 0, squares = 0, largest_step = 0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Vec3<double> p(0.0137 * i, 0.0071 * i, 0.0053 * i);
    const double here = gradient_noise(p);
    sum += here / count;
    squares += here * here / count;
    largest_step =
        std::max(largest_step, std::abs(gradient_noise(p + Vec3<double>(1e-4, 0, 0)) - here));
  }
  EXPECT_NEAR(sum, 0, 0.02);
  EXPECT_GT(squares, 0.03);
  EXPECT_LT(largest_step, 1e-3);
  EXPECT_EQ(gradient_noise({3, -4, 5}), 0);
}

// A textured body of any pose: what is painted on it turns and moves with it.
TEST(Texture, paint_sticks_to_its_object) {
  const auto look = [](const Affine<double>& pose, const Ray<double>& ray) {
    Scene scene;
    auto board = two_colours<CheckerTexture>();
    board.scale = 0.31;
    scene.materials = {{"board", LambertMaterial{Paint(board)}}};
    scene.objects = {{"body", Superellipsoid{{1, 1, 1}, 4}, pose, 0}};
    scene.lights = {EnvironmentLight{}};
    const World world = make_world(scene);
    const Integrator integrator(scene, world);
    TracedRay traced{ray, Sampler(1, 0, 0, 0)};
    RayCounts counts;
    integrator.trace(std::span(&traced, 1), counts);
    EXPECT_TRUE(traced.met);
    return traced.radiance.x();
  };
  Mat3<double> turn;
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Affine<double> pose{turn, {5, 6, 7}};
  int black = 0, white = 0;
  for (int i = 0; i < 40; ++i) {
    const Ray<double> ray{{-0.8 + 0.041 * i, -4, 0.3}, {0, 1, 0}};
    const double value = look({}, ray);
    EXPECT_EQ(value, look(pose, {pose(ray.origin), turn * ray.direction}));
    (value > 0.5 ? white : black) += 1;
  }
  EXPECT_GT(black, 8);
  EXPECT_GT(white, 8);
}

}  // namespace
}  // namespace minkray
