// SPDX-License-Identifier: MIT
// Light by paths, where it is known: under lamps of simple shapes, within glass, and by the two
// ways in which it is found.
#include "renderer/paths/path_transport.h"

#include <gtest/gtest.h>

#include "renderer/film/render.h"
#include "renderer/paths/inside.h"
#include "renderer/paths/integrator.h"
#include "renderer/rays/camera.h"
#include "renderer/surfaces/dielectric_bsdf.h"
#include "tests/support/must_hold.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

constexpr double albedo = 0.8;

Object object(Shape shape, const Vec3<double>& at, std::uint32_t material) {
  return {"", std::move(shape), shifted_by(at), material};
}

/// A matt floor, its top at z = 0, and a lamp of radiance 1 above it.
Scene floor_and_lamp() {
  Scene scene;
  scene.materials = {{"matt", LambertMaterial{Colour::Constant(albedo)}},
                     {"lamp", EmissiveMaterial{Colour::Ones()}}};
  scene.objects.push_back(object(Box{{50, 50, 1}}, {0, 0, -1}, 0));
  return scene;
}

struct Seen {
  Colour mean = Colour::Zero();
  double variance = 0;  ///< of one sample's red
};

/// Radiance of a ray, by `samples` samples.
Seen look(const Scene& scene, const Ray<double>& ray, int samples, IntegratorOptions options = {}) {
  options.kind = IntegratorKind::path;
  const World world = make_world(scene);
  const Integrator integrator(scene, world, options);
  RayCounts counts;
  Seen seen;
  double squares = 0;
  for (int i = 0; i < samples; ++i) {
    TracedRay traced{ray, Sampler(8, 0, 0, static_cast<std::uint32_t>(i))};
    integrator.trace(std::span(&traced, 1), counts);
    seen.mean += traced.radiance / samples;
    squares += traced.radiance.x() * traced.radiance.x() / samples;
  }
  seen.variance = squares - seen.mean.x() * seen.mean.x();
  return seen;
}

/// From the side to the middle of the floor.
Ray<double> to_floor() {
  return {{-3, 0, 0.5}, unit<double>({3, 0, -0.5})};
}

/// The irradiance in the middle of the floor, of a lamp with radiance 1.
double irradiance(const Scene& scene, int samples = 1 << 12) {
  return look(scene, to_floor(), samples, {.max_depth = 1}).mean.x() * std::numbers::pi / albedo;
}

TEST(PathTransport, a_shining_ball_lights_as_the_square_of_its_radius_over_its_height) {
  double worst = 0;
  for (const auto& [radius, height] : {std::pair{1.0, 3.0}, {0.01, 2.0}, {1.9, 2.0}}) {
    Scene scene = floor_and_lamp();
    scene.objects.push_back(object(Sphere{radius}, {0, 0, height}, 1));
    const double expected = std::numbers::pi * radius * radius / (height * height);
    const double part = irradiance(scene) / expected;
    EXPECT_NEAR(part, 1, 1e-3) << radius << " " << height;
    worst = std::max(worst, std::abs(part - 1));
  }
  tell_figure("irradiance_under_a_ball", worst, "<= 0.001");
}

TEST(PathTransport, a_shining_disk_lights_as_its_formula_says) {
  double worst = 0;
  for (const auto& [radius, height] : {std::pair{1.0, 1.5}, {0.05, 2.0}, {3.0, 1.0}}) {
    Scene scene = floor_and_lamp();
    scene.objects.push_back(object(Disk{radius}, {0, 0, height}, 1));
    const double expected =
        std::numbers::pi * radius * radius / (height * height + radius * radius);
    const double part = irradiance(scene, 1 << 14) / expected;
    EXPECT_NEAR(part, 1, 1e-3) << radius << " " << height;
    worst = std::max(worst, std::abs(part - 1));
  }
  tell_figure("irradiance_under_a_disk", worst, "<= 0.001");
}

TEST(PathTransport, half_a_sky_and_a_plane_above_light_with_pi) {
  Scene scene = floor_and_lamp();
  scene.lights = {EnvironmentLight{}};
  const double of_sky = irradiance(scene) / std::numbers::pi;
  EXPECT_NEAR(of_sky, 1, 1e-3);
  tell_figure("irradiance_under_half_a_sky", std::abs(of_sky - 1), "<= 0.001");
  Scene planes = floor_and_lamp();
  Object above = object(Point(), Vec3<double>::Zero(), 1);
  above.half_space = HalfSpaceBody<double>{{0, 0, -1}, -2};
  planes.objects.push_back(above);
  const double of_plane = irradiance(planes) / std::numbers::pi;
  EXPECT_NEAR(of_plane, 1, 1e-3);
  tell_figure("irradiance_between_planes", std::abs(of_plane - 1), "<= 0.001");
}

/// Lamps without a closed form, somewhere above the floor.
std::vector<Shape> odd_lamps() {
  const std::vector<Vec3<double>> points = {{0.3, 0, 0},  {-0.3, 0.1, 0}, {0, 0.5, 0.1},
                                            {0, -0.2, 0}, {0.1, 0, 0.4},  {0, 0.1, -0.3}};
  return {Cone{0.4, 0.5},
          Superellipsoid{{0.5, 0.3, 0.4}, 4},
          Rounded{0.1, Shape(Hull{PointCloud(points)})},
          Capsule{0.05, 0.6},
          Box{{0.6, 0.1, 0.2}},
          Box{{0.5, 0.3, 0.001}}};
}

// Brute force: directions by the cosine alone, and whether they meet the lamp.
TEST(PathTransport, lamps_of_any_shape_light_as_brute_force_says_with_a_20th_of_the_samples) {
  double most_sigmas = 0, least_ratio = std::numeric_limits<double>::infinity();
  for (const Shape& shape : odd_lamps()) {
    Scene scene = floor_and_lamp();
    scene.objects.push_back(object(shape, {0.4, 0.7, 2.5}, 1));
    const World world = make_world(scene);
    QueryCounts counts;
    constexpr int samples = 1 << 18;
    int met = 0;
    for (int i = 0; i < samples; ++i) {
      Sampler sampler(4, 0, 0, static_cast<std::uint32_t>(i));
      const Ray<double> ray{{0, 0, 0}, cosine_direction(sampler.next())};
      met += world.closest_hit(ray, counts, 0).instance == 1 ? 1 : 0;
    }
    const double part = static_cast<double>(met) / samples;
    const double of_one = albedo * albedo * part * (1 - part);
    ASSERT_GT(met, 500);
    const Seen seen = look(scene, to_floor(), 1 << 14, {.max_depth = 1});
    const double sigma = std::sqrt(of_one / samples + seen.variance / (1 << 14));
    EXPECT_NEAR(seen.mean.x(), albedo * part, 3 * sigma);
    EXPECT_LT(seen.variance, of_one / 20) << shape.kind.index();
    most_sigmas = std::max(most_sigmas, std::abs(seen.mean.x() - albedo * part) / sigma);
    least_ratio = std::min(least_ratio, of_one / seen.variance);
  }
  tell_figure("lamps_of_any_shape_sigmas_off_brute_force", most_sigmas, "<= 3");
  tell_figure("lamps_of_any_shape_samples_saved_by", least_ratio, ">= 20");
}

// Shining bodies among others that shine, and one that is rough and sees them: what both ways find
// is not counted twice.
TEST(PathTransport, a_furnace_of_lamps_is_even) {
  for (const MaterialKind& kind :
       {MaterialKind(LambertMaterial{Colour::Ones()}),
        MaterialKind(GlossyMaterial{Colour::Ones(), 0.4, 1.5}),
        MaterialKind(ConductorMaterial{{}, Colour::Ones(), 0.5, 0.3}),
        MaterialKind(TranslucentMaterial{Colour::Ones(), 0.4}),
        MaterialKind(DielectricMaterial{1.5, 0}), MaterialKind(DielectricMaterial{1.4, 0.5})}) {
    Scene scene;
    scene.materials = {{"white", kind}, {"lamp", EmissiveMaterial{Colour::Ones()}}};
    scene.objects.push_back(object(Sphere{1}, {0, 0, 0}, 0));
    // Six plates around it, which meet at their edges.
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        Vec3<double> half = Vec3<double>::Constant(3), at = Vec3<double>::Zero();
        half[axis] = 0.5;
        at[axis] = 3 * side;
        scene.objects.push_back(object(Box{half}, at, 1));
      }
    const Ray<double> ray{{0, -2, 0.3}, unit<double>({0.1, 2, 0.2})};
    // Light that enters a hollow body leaves it much later or soon: it takes more samples.
    const int samples = std::holds_alternative<TranslucentMaterial>(kind) ? 1 << 16 : 1 << 12;
    EXPECT_NEAR(look(scene, ray, samples, {.max_depth = 200}).mean.x(), 1, 0.012) << kind.index();
  }
}

// Light from one side alone: a flat sheet sends its part to either side, once.
TEST(PathTransport, a_flat_sheet_lets_light_through_once) {
  constexpr double transmission = 0.3;
  for (const Shape& shape : {Shape(Disk{1}), Shape(Box{{1, 1, 0}})})
    for (const bool from_behind : {false, true}) {
      Scene scene;
      scene.materials = {{"paper", TranslucentMaterial{Colour::Constant(albedo), transmission}}};
      scene.objects = {object(shape, {0, 0, 0}, 0)};
      scene.lights = {DirectionalLight{{0, 0, from_behind ? 1.0 : -1.0}, Colour::Ones()}};
      const Ray<double> ray{{0.1, -1, 2}, unit<double>({0, 1, -2})};
      const double part = from_behind ? transmission : 1 - transmission;
      EXPECT_NEAR(look(scene, ray, 4).mean.x(), part * albedo / std::numbers::pi, 1e-12);
    }
}

// A lantern: light goes through its shell once it has been thrown about within, and none is lost.
TEST(PathTransport, a_lamp_in_a_white_lantern_shines_with_all_of_its_light) {
  Scene scene;
  scene.materials = {{"paper", TranslucentMaterial{Colour::Ones(), 0.5}},
                     {"lamp", EmissiveMaterial{Colour::Ones()}}};
  scene.objects = {object(Sphere{1}, {0, 0, 0}, 0), object(Sphere{0.02}, {0, 0, 0}, 1)};
  // The lamp sends pi * area; of an even sphere as much leaves each part. The lamp itself absorbs
  // what falls back on it, a few parts in 10^4.
  const Ray<double> ray{{0.2, -4, 0.3}, {0, 1, 0}};
  const double expected = 0.02 * 0.02;
  EXPECT_NEAR(look(scene, ray, 1 << 12, {.max_depth = 200}).mean.x() / expected, 1, 0.03);
}

/// A ball of glass with a core, in blue light, at a scale.
Scene shell(double scale, const MaterialKind& core) {
  Scene scene;
  scene.materials = {{"glass", DielectricMaterial{1.5}}, {"core", core}};
  scene.lights = {EnvironmentLight{{0, 0, 1}, {0, 0, 1}}};
  scene.background = {{0, 0, 1}, {0, 0, 1}};
  scene.objects = {object(Sphere{scale}, {0, 0, 0}, 0),
                   object(Sphere{scale * (1 - 4e-5)}, {0, 0, 0}, 1)};
  return scene;
}

/// Rays from a camera to all places of a ball, and just outside of it.
template <class Visit>
void for_rays_at_ball(double scale, const Visit& visit) {
  for (int y = -64; y <= 64; ++y)
    for (int x = -64; x <= 64; ++x) {
      const Vec3<double> at(x / 63.5 * scale, y / 63.5 * scale, 0);
      const Vec3<double> eye(0.1 * scale, 0.2 * scale, 7 * scale);
      visit(Ray<double>{eye, unit<double>(at - eye)});
    }
}

// Two balls of glass, of radius 1 and 1 - 4e-5, leaked (mitsuba3, issue 1871). Light that enters
// this one must meet its core, which shines red: with one event a path that leaks is black.
TEST(PathTransport, a_shell_of_glass_4e_5_thick_does_not_leak_at_any_scale) {
  int all_leaks = 0;
  for (const double scale : {1e-3, 1.0, 1e6}) {
    const Scene scene = shell(scale, EmissiveMaterial{{1, 0, 0}});
    const World world = make_world(scene);
    const Integrator integrator(scene, world, {.kind = IntegratorKind::path, .max_depth = 1});
    RayCounts counts;
    int red = 0, blue = 0, leaks = 0;
    std::uint32_t i = 0;
    for_rays_at_ball(scale, [&](const Ray<double>& ray) {
      TracedRay traced{ray, Sampler(1, 0, 0, i++)};
      integrator.trace(std::span(&traced, 1), counts);
      const Colour& c = traced.radiance;
      const bool is_red = std::abs(c.x() - 1 / 2.25) < 1e-12 && c.z() == 0;
      const bool is_blue = c.x() == 0 && std::abs(c.z() - 1) < 1e-12;
      (is_red ? red : is_blue ? blue : leaks) += 1;
    });
    EXPECT_EQ(leaks, 0) << scale;
    all_leaks += leaks;
    EXPECT_GT(red, 8000);
    EXPECT_GT(blue, 3000);
    EXPECT_EQ(counts.work.exhausted, 0u);
  }
  tell_figure("pixels_that_leak_through_a_thin_shell", all_leaks, "<= 0");
}

TEST(PathTransport, an_empty_shell_of_glass_loses_nothing_at_any_scale) {
  for (const double scale : {1e-3, 1.0, 1e6}) {
    const Scene scene = shell(scale, DielectricMaterial{1.0});
    const World world = make_world(scene);
    const Integrator integrator(scene, world, {.kind = IntegratorKind::path, .max_depth = 1000});
    RayCounts counts;
    std::uint32_t i = 0;
    for_rays_at_ball(scale, [&](const Ray<double>& ray) {
      TracedRay traced{ray, Sampler(1, 0, 0, i++)};
      integrator.trace(std::span(&traced, 1), counts);
      EXPECT_NEAR(traced.radiance.z(), 1, 1e-9);
    });
  }
}

TEST(PathTransport, a_ball_lens_focuses_where_its_formula_says) {
  double worst = 0;
  for (const double eta : {1.33, 1.5, 1.8}) {
    Scene scene;
    scene.materials = {{"glass", DielectricMaterial{eta}}};
    scene.objects = {object(Sphere{2}, {0, 0, 0}, 0)};
    const World world = make_world(scene);
    const auto glass = make_bsdf(scene.materials[0]);
    WorldRay ray{{{0.01, 0, -9}, {0, 0, 1}}};
    Inside inside;
    QueryCounts counts;
    for (const bool leaves : {false, true}) {
      const Boundary at = next_boundary(world, ray, inside, counts);
      ASSERT_EQ(at.instance, 0u);
      ASSERT_EQ(at.leaves, leaves);
      const Frame frame(at.normal);
      const auto through =
          glass->sample({frame.to_local(-ray.ray.direction), 1, eta}, {{0.5, 0.5}, 0.999});
      ASSERT_TRUE(through);
      ray.ray = {ray.ray.at(at.t), frame.to_world(through->w_in)};
      ray.skip = 0;
      leaves ? inside.leave(0) : static_cast<void>(inside.enter(0));
    }
    const double crossing =
        ray.ray.origin.z() - ray.ray.origin.x() / ray.ray.direction.x() * ray.ray.direction.z();
    const double part = crossing / (eta * 2 / (2 * (eta - 1)));
    EXPECT_NEAR(part, 1, 1e-3);
    worst = std::max(worst, std::abs(part - 1));
  }
  tell_figure("focus_of_a_ball_lens", worst, "<= 0.001");
}

TEST(PathTransport, glass_dims_by_the_exact_length_of_the_way_through_it) {
  Scene scene;
  scene.materials = {{"smoke", DielectricMaterial{1.0, 0, {0.3, 0.7, 1.1}}}};
  scene.objects = {object(Superellipsoid{{1, 1, 1}, 5}, {0, 0, 0}, 0)};
  scene.background = {Colour::Ones(), Colour::Ones()};
  const Ray<double> ray{{0.2, -4, 0.1}, {0, 1, 0}};
  const double half = std::pow(1 - std::pow(0.2, 5) - std::pow(0.1, 5), 0.2);
  const Colour seen = look(scene, ray, 16).mean;
  EXPECT_NEAR(seen.x(), std::exp(-0.3 * 2 * half), 1e-12);
  EXPECT_NEAR(seen.z(), std::exp(-1.1 * 2 * half), 1e-12);
}

// A body of greater priority is there where two overlap, whichever was entered first.
TEST(PathTransport, where_bodies_overlap_the_greater_priority_counts) {
  for (const double priority : {-1.0, 1.0}) {
    Scene scene;
    scene.materials = {{"red", DielectricMaterial{1.0, 0, {0, 1, 1}, priority}},
                       {"blue", DielectricMaterial{1.0, 0, {1, 1, 0}, 0}}};
    scene.objects = {object(Box{{1, 1, 1}}, {0, 0, 0}, 0), object(Box{{1, 1, 1}}, {0, 1, 0}, 1)};
    scene.background = {Colour::Ones(), Colour::Ones()};
    // One unit of the first alone, one of both, one of the second alone.
    const Colour seen = look(scene, {{0.1, -4, 0.2}, {0, 1, 0}}, 1).mean;
    EXPECT_NEAR(seen.x(), std::exp(priority > 0 ? -1.0 : -2.0), 1e-12);
    EXPECT_NEAR(seen.z(), std::exp(priority > 0 ? -2.0 : -1.0), 1e-12);
  }
}

TEST(PathTransport, a_ray_sees_the_same_bits_alone_and_with_others) {
  Scene scene = floor_and_lamp();
  scene.materials.push_back({"glass", DielectricMaterial{1.5, 0.3, {0.1, 0.2, 0.3}}});
  scene.materials.push_back({"gold", ConductorMaterial{{"gold"}, std::nullopt, 0.3, 0.5}});
  scene.objects.push_back(object(Sphere{0.3}, {0.5, 1, 2}, 1));
  scene.objects.push_back(object(Sphere{0.5}, {-0.6, 0, 0.5}, 2));
  scene.objects.push_back(object(Box{{0.2, 0.4, 0.3}}, {0.7, 0, 0.3}, 3));
  scene.lights = {PointLight{{0, -2, 3}, {2, 2, 2}}, EnvironmentLight{{0.2, 0.3, 0.4}, {0, 0, 0}}};
  scene.camera.position = {0, -4, 2};
  scene.camera.resolution = {32, 32};
  const World world = make_world(scene);
  const Camera camera(scene.camera, scene.camera.resolution);
  const Integrator integrator(scene, world);
  RayCounts counts, counts_together;
  int lit = 0;
  for (int y = 0; y < 32; ++y) {
    std::vector<TracedRay> alone;
    for (int x = 0; x < 32; ++x)
      alone.push_back({camera.ray(x + 0.5, y + 0.5), Sampler(2, x, y, 0)});
    std::vector<TracedRay> together = alone;
    for (TracedRay& ray : alone) integrator.trace(std::span(&ray, 1), counts);
    integrator.trace(together, counts_together);
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_EQ(alone[i].radiance, together[i].radiance);
      lit += alone[i].radiance.maxCoeff() > 0.01 ? 1 : 0;
    }
  }
  EXPECT_GT(lit, 500);
  EXPECT_EQ(counts.total(), counts_together.total());
}

}  // namespace
}  // namespace minkray
