// SPDX-License-Identifier: MIT
// Textures are the means over a ray's footprint: compared with many points of them, which are the
// truth.
#include <gtest/gtest.h>

#include "renderer/film/render.h"
#include "renderer/image/filter.h"
#include "renderer/image/pyramid.h"
#include "renderer/rays/camera.h"
#include "renderer/surfaces/box_filter.h"
#include "renderer/surfaces/scene_surfaces.h"
#include "renderer/surfaces/texture.h"
#include "tests/support/must_hold.h"
#include "tests/support/random.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

template <class T>
T black_and_white(const char* mapping) {
  T texture;
  texture.a = Colour::Ones();
  texture.b = Colour::Zero();
  texture.mapping.name = mapping;
  return texture;
}

/// The mean of points that are spread evenly over the footprint; the surface is flat there.
double by_points(const Paint& paint, const TexturePoint& at, int side) {
  double sum = 0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double u = (i + 0.5) / side - 0.5, v = (j + 0.5) / side - 0.5;
      sum +=
          paint_at(paint, {at.position + u * at.footprint[0] + v * at.footprint[1], at.normal}).x();
    }
  return sum / (side * side);
}

/// Standard deviations from the mean by points, over many places with upright footprints.
struct Errors {
  double filtered = 0, of_points = 0;
};

template <class T>
Errors errors_of(const T& texture, double width, int side) {
  const Paint paint{TextureKind(texture)};
  Errors squares;
  constexpr int places = 60;
  for (int i = 0; i < places; ++i) {
    const Vec3<double> position(0.917 * i - 20.3, 0.531 * i - 11.7, 0.377 * i);
    const Vec3<double> up = Vec3<double>::UnitZ();
    const TexturePoint at{
        position, up, {width * Vec3<double>::UnitX(), width * Vec3<double>::UnitY()}};
    const double truth = by_points(paint, at, side);
    squares.filtered += std::pow(paint_at(paint, at).x() - truth, 2) / places;
    squares.of_points += std::pow(paint_at(paint, {position, up}).x() - truth, 2) / places;
  }
  return {std::sqrt(squares.filtered), std::sqrt(squares.of_points)};
}

template <class T>
double error_of(const T& texture, double width, int side) {
  return errors_of(texture, width, side).filtered;
}

TEST(FilteredTexture, fields_lines_and_ramps_are_means_over_boxes_to_the_last_digits) {
  for (const double width : {0.05, 0.37, 1.0, 2.9}) {
    // A row or two of the points are on the wrong side of an edge.
    constexpr int points = 160;
    EXPECT_LT(error_of(black_and_white<CheckerTexture>("planar"), width, points), 0.006) << width;
    EXPECT_LT(error_of(black_and_white<GridTexture>("planar"), width, points), 0.006) << width;
    EXPECT_LT(error_of(black_and_white<GradientTexture>("planar"), width, points), 1e-4) << width;
  }
  EXPECT_DOUBLE_EQ(mean_of_fields(0.5, 1), 1);
  EXPECT_DOUBLE_EQ(mean_of_fields(1, 0.5), 0);
  EXPECT_DOUBLE_EQ(mean_of_fields(-0.25, 1), -0.5);
  EXPECT_DOUBLE_EQ(mean_of_lines(0.3, 7, 0.05), 0.05);
  EXPECT_DOUBLE_EQ(mean_of_lines(-4, 0.1, 0.05), 0.5);
  EXPECT_DOUBLE_EQ(mean_of_ramp(0, 1), 0.125);
  EXPECT_DOUBLE_EQ(mean_of_cubes(-3.5, 8), 0.25);
  EXPECT_NEAR(mean_of_veins(0.3, 5), 35.0 / 128, 1e-15);
  EXPECT_NEAR(mean_of_veins(0.3, 2e-6), mean_of_veins(0.3, 0), 1e-9);
}

// Noise is faded, not integrated: it comes near by its strength, not by its pattern.
TEST(FilteredTexture, noise_fades_to_its_mean) {
  for (const double width : {0.4, 1.5, 4.0})
    for (const auto& [filtered, of_points] :
         {errors_of(black_and_white<NoiseTexture>("planar"), width, 48),
          errors_of(black_and_white<MarbleTexture>("planar"), width, 48),
          errors_of(black_and_white<WoodTexture>("planar"), width, 48)}) {
      EXPECT_LT(filtered, 0.7 * of_points) << width;
      EXPECT_LT(filtered, 0.13) << width;
    }
}

TEST(FilteredTexture, a_point_is_what_it_was) {
  for (int i = 0; i < 50; ++i) {
    const Vec3<double> p(0.817 * i - 20.3, 0.631 * i - 11.7, 0);
    const TexturePoint point{p, Vec3<double>::UnitZ()};
    const TexturePoint tiny{
        p, Vec3<double>::UnitZ(), {Vec3<double>(1e-9, 0, 0), Vec3<double>(0, 1e-9, 0)}};
    const auto same = [&](const auto& texture) {
      const Paint paint{TextureKind(texture)};
      EXPECT_NEAR(paint_at(paint, point).x(), paint_at(paint, tiny).x(), 1e-6);
    };
    same(black_and_white<CheckerTexture>("planar"));
    same(black_and_white<GridTexture>("planar"));
    same(black_and_white<NoiseTexture>("planar"));
    same(black_and_white<MarbleTexture>("planar"));
    same(black_and_white<WoodTexture>("planar"));
  }
}

Image random_picture(int width, int height) {
  Image image(width, height);
  testing::Random random(7);
  for (Vec3<float>& pixel : image.pixels)
    for (float& value : pixel) value = static_cast<float>(random.uniform(0, 1));
  return image;
}

TEST(FilteredTexture, smaller_pictures_have_the_same_mean) {
  for (const auto& [width, height] : {std::pair{64, 32}, {61, 37}, {1, 5}, {3, 1}, {1, 1}}) {
    const Image image = random_picture(width, height);
    Colour mean = Colour::Zero();
    for (const Vec3<float>& pixel : image.pixels) mean += pixel.cast<double>();
    mean /= width * height;
    const std::vector<Image> smaller = smaller_images(image);
    for (const Image& one : smaller) {
      Colour of_one = Colour::Zero();
      for (const Vec3<float>& pixel : one.pixels) of_one += pixel.cast<double>();
      // Sides of an odd number of pixels are cut again each time; the mean stays.
      EXPECT_NEAR((of_one / (one.width * one.height) - mean).norm(), 0, 1e-5);
    }
    ASSERT_EQ(smaller.empty(), width == 1 && height == 1);
    if (smaller.empty()) continue;
    EXPECT_EQ(smaller.back().width, 1);
    EXPECT_EQ(smaller.back().height, 1);
  }
}

TEST(FilteredTexture, a_picture_far_away_is_its_mean_and_near_by_as_it_was) {
  const auto image = std::make_shared<const Image>(random_picture(61, 37));
  for (const char* mapping : {"radial", "box", "planar", "normal"}) {
    const Paint paint{TextureKind(ImageTexture{{"x.png", image}, {mapping}, 1})};
    const Vec3<double> p = 5 * unit<double>({0.3, -0.4, 0.86});
    const auto at = [&](double width) {
      const Vec3<double> n = unit(p), x = unit<double>(n.cross(Vec3<double>::UnitZ()));
      return paint_at(paint, {p, n, {width * x, width * n.cross(x)}});
    };
    // Around an axis that is a whole turn, and no more: pictures meet themselves there.
    const bool is_turn = mapping == std::string("radial") || mapping == std::string("normal");
    EXPECT_NEAR((at(100) - paint.colour()).norm(), 0, is_turn ? 0.01 : 1e-5) << mapping;
    EXPECT_EQ((at(1e-3) - at(0)).norm(), 0) << mapping;
    EXPECT_GT((at(0) - paint.colour()).norm(), 0.05) << mapping;
  }
}

// Around a ball, where all four mappings have a known rate of change.
TEST(FilteredTexture, footprints_go_through_mappings) {
  const double h = 1e-5;
  for (const char* name : {"radial", "box", "planar", "normal", ""}) {
    const Mapping mapping{name};
    for (const Vec3<double>& n :
         {unit<double>({0.3, -0.4, 0.86}), unit<double>({-0.8, 0.1, -0.3})}) {
      const double radius = 3;
      const Vec3<double> x = unit<double>(n.cross(Vec3<double>(1, 2, 3)));
      const TexturePoint here{radius * n, n, {h * x, Vec3<double>::Zero()}};
      const TexturePoint there{radius * unit<double>(n + h / radius * x),
                               unit<double>(n + h / radius * x)};
      const Vec3<double> change =
          texture_place(there, mapping, 0.7).middle - texture_place(here, mapping, 0.7).middle;
      EXPECT_NEAR((texture_place(here, mapping, 0.7).sides[0] - change).norm() / h, 0, 1e-4)
          << name;
    }
  }
}

TEST(FilteredTexture, a_cone_lights_what_its_rim_meets) {
  const Vec3<double> normal = unit<double>({0.2, 0.1, 1}), direction = unit<double>({1, 0.5, -0.8});
  const RayCone cone = RayCone{0, 1e-4}.at(3);
  const SurfaceFootprint footprint = footprint_of(cone, direction, normal);
  for (const Vec3<double>& axis : footprint) {
    EXPECT_NEAR(axis.dot(normal), 0, 1e-15);
    // Seen along the ray, each end lies on the cone's rim.
    EXPECT_NEAR((axis - axis.dot(direction) * direction).norm(), 3e-4, 1e-12);
  }
  EXPECT_NEAR(footprint[0].dot(footprint[1]), 0, 1e-15);
  EXPECT_DOUBLE_EQ(cone.refracted(1.5).refracted(1 / 1.5).spread, cone.spread);
}

/// A floor of fields to the horizon, seen through any object in front of the camera.
Scene floor_of_fields() {
  Scene scene;
  scene.camera.position = {0.2, 0, 1};
  scene.camera.look_at = {0.2, 10, 0.2};
  scene.camera.fov_y_degrees = 40;
  CheckerTexture fields = black_and_white<CheckerTexture>("planar");
  fields.scale = 0.25;
  scene.materials = {{"fields", LambertMaterial{Paint(TextureKind(fields))}}};
  scene.objects = {{"floor", Box{{5000, 5000, 1}}, shifted_by(0, 0, -1), 0}};
  scene.lights = {EnvironmentLight{Colour::Ones(), Colour::Ones()}};
  scene.background = {Colour::Ones(), Colour::Ones()};
  return scene;
}

Image picture_of(const Scene& scene, int samples, std::uint64_t seed) {
  RenderOptions options;
  options.resolution = {48, 32};
  options.samples = samples;
  options.seed = seed;
  options.integrator.kind = IntegratorKind::path;
  return render(scene, make_world(scene), options).image;
}

double mean_of(const Image& image) {
  double sum = 0;
  for (const Vec3<float>& pixel : image.pixels) sum += pixel.x();
  return sum / static_cast<double>(image.pixels.size());
}

double error(const Image& image, const Image& truth) {
  double squares = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    squares += std::pow(image.pixels[i].x() - truth.pixels[i].x(), 2);
  return std::sqrt(squares / static_cast<double>(image.pixels.size()));
}

// With 1024 samples a ray represents a 32nd of a pixel: that is as good as points.
TEST(FilteredTexture, fields_to_the_horizon_are_calm_at_one_sample_a_pixel) {
  const Scene scene = floor_of_fields();
  const Image truth = picture_of(scene, 1024, 1), one = picture_of(scene, 1, 2);
  // Evaluated at points: rays without a footprint.
  const Image points = [&] {
    const World world = make_world(scene);
    const Camera camera(scene.camera, {48, 32});
    const PixelFilter filter;
    const SceneSurfaces surfaces(scene);
    Image image(48, 32);
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 48; ++x) {
        Sampler sampler(2, x, y, 0);
        const auto u = sampler.next();
        const Ray<double> ray =
            camera.ray(x + 0.5 + filter.offset(u[0]), y + 0.5 + filter.offset(u[1]));
        QueryCounts counts;
        Colour albedo = Colour::Ones(), emission;
        surfaces.describe(world, ray, {}, world.closest_hit(ray, counts), albedo, emission);
        image.at(x, y) = albedo.cast<float>();
      }
    return image;
  }();
  const double of_filtered = error(one, truth), of_points = error(points, truth);
  EXPECT_NEAR(mean_of(one), mean_of(truth), 0.01);
  EXPECT_LT(of_filtered, 0.5 * of_points);
  tell_figure("error_of_a_textured_floor_at_1_sample_over_that_of_points", of_filtered / of_points,
              "<= 0.5");
}

}  // namespace
}  // namespace minkray
