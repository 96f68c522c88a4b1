// SPDX-License-Identifier: MIT
// Meshes as lamps: densities of their samples, and light that is known.
#include "renderer/lights/mesh_lamp.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/files/mesh_attributes.h"
#include "renderer/film/render.h"
#include "renderer/paths/integrator.h"
#include "tests/support/density.h"
#include "tests/support/meshes.h"

namespace minkray {
namespace {

using testing::Surface;

constexpr double matt_albedo = 0.8;

Object lamp_of(const Surface& surface, const Affine<double>& pose) {
  Object object;
  object.mesh = surface.shared();
  object.pose = pose;
  object.material = 1;
  return object;
}

/// A matt floor, its top at z = 0, and a lamp of radiance 1.
Scene floor_under(Object lamp) {
  Scene scene;
  scene.materials = {{"matt", LambertMaterial{Colour::Constant(matt_albedo)}},
                     {"lamp", EmissiveMaterial{Colour::Ones()}}};
  Object floor;
  floor.shape = Box{{50, 50, 1}};
  floor.pose.translation = {0, 0, -1};
  lamp.material = 1;
  scene.objects = {std::move(floor), std::move(lamp)};
  return scene;
}

struct MeanLight {
  double mean = 0, error = 0;  ///< of the mean
};

/// Radiance at the middle of the floor, or along another ray.
MeanLight look(const Scene& scene, int samples, int max_depth = 1,
               const Ray<double>& ray = {{-3, 0, 0.5}, unit<double>({3, 0, -0.5})}) {
  const World world = make_world(scene);
  const Integrator integrator(scene, world, {.kind = IntegratorKind::path, .max_depth = max_depth});
  RayCounts counts;
  double sum = 0, squares = 0;
  for (int i = 0; i < samples; ++i) {
    TracedRay traced{ray, Sampler(8, 0, 0, static_cast<std::uint32_t>(i))};
    integrator.trace({&traced, 1}, counts);
    sum += traced.radiance.x();
    squares += traced.radiance.x() * traced.radiance.x();
  }
  const double mean = sum / samples;
  return {mean, std::sqrt((squares / samples - mean * mean) / samples)};
}

Affine<double> pose_at(double x, double y, double z, double scale = 1) {
  return {scale * Mat3<double>::Identity(), {x, y, z}};
}

// Under the corner of a rectangle of sides a and b at height h, the irradiance of radiance 1 is
// (a / p atan(b / p) + b / q atan(a / q)) / 2, p^2 = a^2 + h^2, q^2 = b^2 + h^2.
double under_corner(double a, double b, double h) {
  const double p = std::hypot(a, h), q = std::hypot(b, h);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / 2;
}

TEST(MeshLamp, a_box_of_triangles_lights_the_floor_as_its_bottom_does) {
  // From straight below, the bottom of the box is all that is seen of it.
  const Scene scene = floor_under(lamp_of(testing::block({0.8, 0.5, 0.1}), pose_at(0, 0, 1.1)));
  const double expected = matt_albedo / std::numbers::pi * 4 * under_corner(0.8, 0.5, 1);
  const MeanLight seen = look(scene, 1 << 14);
  EXPECT_NEAR(seen.mean, expected, 4 * seen.error);
  EXPECT_LT(seen.error, 0.01 * expected);
}

TEST(MeshLamp, a_ball_of_triangles_lights_the_floor_as_a_ball) {
  Surface ball = testing::bumpy_ball(60, 80);
  for (Vec3<double>& vertex : ball.vertices) vertex.normalize();
  Affine<double> pose = pose_at(0.4, 0.2, 1.5, 0.5);
  Object exact;
  exact.shape = Sphere{0.5};
  exact.pose.translation = pose.translation;
  const MeanLight truth = look(floor_under(exact), 1 << 14);
  for (const bool is_mirrored : {false, true}) {
    if (is_mirrored) pose.linear.col(0) *= -1;
    const MeanLight seen = look(floor_under(lamp_of(ball, pose)), 1 << 14);
    // The triangles' outline has 0.4 % less area.
    EXPECT_NEAR(seen.mean, truth.mean,
                4 * std::hypot(seen.error, truth.error) + 0.005 * truth.mean);
    EXPECT_LT(seen.error, 0.02 * seen.mean);
  }
}

TEST(MeshLamp, a_small_lamp_is_not_left_to_chance) {
  // One path in 200,000 would meet it.
  Surface ball = testing::bumpy_ball(20, 30);
  for (Vec3<double>& vertex : ball.vertices) vertex.normalize();
  const Scene scene = floor_under(lamp_of(ball, pose_at(0, 0, 2, 0.01)));
  const double expected = matt_albedo * 0.01 * 0.01 / 4;
  const MeanLight seen = look(scene, 1 << 12);
  EXPECT_NEAR(seen.mean, expected, 0.03 * expected);
}

TEST(MeshLamp, an_open_mesh_shines_to_both_sides) {
  const Surface sheet{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const double expected = matt_albedo / std::numbers::pi * 4 * under_corner(1, 1, 1);
  for (const double side : {1.0, -1.0}) {
    Affine<double> pose = pose_at(0, 0, 1);
    pose.linear(2, 2) = pose.linear(0, 0) = side;
    const MeanLight seen = look(floor_under(lamp_of(sheet, pose)), 1 << 14);
    EXPECT_NEAR(seen.mean, expected, 4 * seen.error);
  }
}

// Within an emissive mesh of radiance 1 a white body shows 1 as well, in whatever way its light is
// found.
TEST(MeshLamp, a_white_body_within_a_lamp_is_as_bright_as_the_lamp) {
  Surface ball = testing::bumpy_ball(20, 30);
  for (const MaterialKind& kind :
       {MaterialKind(LambertMaterial{Colour::Ones()}),
        MaterialKind(ConductorMaterial{{}, Paint(Colour::Ones()), 0.3})}) {
    Scene scene;
    scene.materials = {{"white", kind}, {"lamp", EmissiveMaterial{Colour::Ones()}}};
    Object body;
    body.shape = Box{{0.3, 0.3, 0.3}};
    scene.objects = {std::move(body), lamp_of(ball, pose_at(0.1, 0, 0, 2))};
    const MeanLight seen =
        look(scene, 1 << 13, 200, {{0.1, -1.2, 0.2}, unit<double>({0, 1, -0.1})});
    EXPECT_NEAR(seen.mean, 1, 4 * seen.error + 0.002) << kind.index();
  }
}

TEST(MeshLamp, only_triangles_that_shine_are_lamps) {
  // The bottom of a block is its first two triangles.
  const Surface block = testing::block({0.8, 0.5, 0.1});
  MeshAttributes attributes;
  attributes.material_of.assign(block.triangles.size(), 0);
  attributes.material_of[0] = attributes.material_of[1] = 1;
  Object lamp = lamp_of(block, pose_at(0, 0, 1.1));
  lamp.look = std::make_shared<const MeshLook>(
      MeshLook{std::make_shared<const MeshAttributes>(std::move(attributes)), {2, 1}});
  Scene scene = floor_under(std::move(lamp));
  scene.materials.push_back({"black", LambertMaterial{Colour::Zero()}});
  scene.objects[1].material = 2;
  const double expected = matt_albedo / std::numbers::pi * 4 * under_corner(0.8, 0.5, 1);
  const MeanLight seen = look(scene, 1 << 14);
  EXPECT_NEAR(seen.mean, expected, 4 * seen.error);
  EXPECT_LT(seen.error, 0.01 * expected);
}

/// Counts the directions that a lamp draws from the origin, and integrates their density. Each of
/// the triangles along a direction may have drawn it.
DensityCheck check_lamp(const Surface& surface, const Affine<double>& pose) {
  const PosedMesh posed(0, surface.shared(), pose);
  const MeshLamp lamp(posed, [](std::uint32_t part) { return part % 5 * 1.0; });
  const Vec3<double> point(0, 0, 0);
  const Mat3<double> to_mesh = pose.linear.inverse();
  const auto pdf = [&](const Vec3<double>& direction) {
    double sum = 0;
    const Ray<double> ray{to_mesh * (point - pose.translation), to_mesh * direction};
    for (const PartHit& hit : all_parts(*posed.mesh, ray))
      sum += lamp.pdf(point, direction, hit.part, hit.t);
    return sum;
  };
  return check_density(
      [&](Sampler& sampler) -> std::optional<Vec3<double>> {
        const double which = sampler.next()[0];
        const auto sample = lamp.sample(point, which, sampler.next());
        if (!sample || !(lamp.pdf(point, sample->direction, sample->part, sample->distance) > 0))
          return std::nullopt;
        return sample->direction;
      },
      pdf);
}

TEST(MeshLamp, directions_have_the_density_that_is_claimed) {
  // A ring around the point, with a gap: from both sides of it.
  Surface ring = testing::torus(24, 12);
  ring.triangles.pop_back();
  expect_density(check_lamp(ring, pose_at(0.1, 0.05, 0.2, 2)));
}

TEST(MeshLamp, a_closed_mesh_is_not_lit_from_behind) {
  // A point outside of its box draws triangles that face away as well, for nothing.
  const DensityCheck check = check_lamp(testing::torus(24, 12), pose_at(0.5, 2, 0.3, 0.7));
  EXPECT_NEAR(check.drawn, check.total, 0.01 * check.total);
  EXPECT_GT(check.total, 0.4);
  EXPECT_LT(check.total, 0.6);
}

}  // namespace
}  // namespace minkray
