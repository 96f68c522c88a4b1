// SPDX-License-Identifier: MIT
// Meshes in pictures: interpolated normals, texture coordinates, and materials by triangle.
#include <gtest/gtest.h>

#include <numbers>

#include "core/files/mesh_attributes.h"
#include "core/mesh/mesh_ray.h"
#include "core/parallel/parallel.h"
#include "renderer/film/render.h"
#include "renderer/paths/integrator.h"
#include "renderer/rays/camera.h"
#include "renderer/surfaces/mesh_point.h"
#include "tests/support/meshes.h"

namespace minkray {
namespace {

using testing::Surface;

/// A ball of radius 1 of triangles, and its own normals at the vertices.
Surface coarse_ball(std::uint32_t rings, std::uint32_t around) {
  Surface ball = testing::bumpy_ball(rings, around);
  for (Vec3<double>& vertex : ball.vertices) vertex.normalize();
  return ball;
}

MeshAttributes normals_of_ball(const Surface& ball) {
  MeshAttributes made;
  for (const Vec3<double>& vertex : ball.vertices) made.normals.push_back(attribute_normal(vertex));
  made.normal_of = ball.triangles;
  settle(made);
  return made;
}

std::shared_ptr<const MeshLook> look_with(MeshAttributes attributes,
                                          std::vector<std::uint32_t> materials = {}) {
  return std::make_shared<const MeshLook>(MeshLook{
      std::make_shared<const MeshAttributes>(std::move(attributes)), std::move(materials)});
}

Scene lit_scene(Object object) {
  Scene scene;
  scene.camera.position = {0, -5, 0};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.fov_y_degrees = 30;
  scene.camera.resolution = {60, 60};
  scene.background = {Colour::Zero(), Colour::Zero()};
  scene.materials = {{"white", LambertMaterial{Colour::Ones()}}};
  scene.lights = {DirectionalLight{Vec3<double>(-0.5, 1, -0.4), Colour::Constant(3)}};
  scene.objects = {std::move(object)};
  return scene;
}

Object mesh_object(const Surface& surface, std::shared_ptr<const MeshLook> its = nullptr) {
  Object object;
  object.name = "mesh";
  object.mesh = surface.shared();
  object.look = std::move(its);
  return object;
}

Image rendered(const Scene& scene, IntegratorKind kind, int threads = 1, int samples = 4) {
  RenderOptions options;
  options.resolution = scene.camera.resolution;
  options.samples = samples;
  options.integrator.kind = kind;
  Image image;
  with_threads(threads, [&] { image = render(scene, make_world(scene), options).image; });
  return image;
}

/// The mean difference of lit pixels within an ellipse around the middle: outlines of a coarse mesh
/// lie elsewhere, and beyond the terminator it shades itself.
double mean_difference(const Image& a, const Image& b, double half_width = 18,
                       double half_height = 18) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      if (std::hypot((x - 29.5) / half_width, (y - 29.5) / half_height) > 1) continue;
      const double of_a = a.at(x, y).x(), of_b = b.at(x, y).x();
      if (of_a < 0.25) continue;
      sum += std::abs(of_a - of_b);
      ++count;
    }
  EXPECT_GT(count, 300);
  return sum / count;
}

TEST(MeshShading, a_coarse_ball_with_normals_is_lit_as_a_ball) {
  Object exact;
  exact.name = "ball";
  exact.shape = Sphere{1};
  const Surface ball = coarse_ball(12, 20);
  for (const IntegratorKind kind : {IntegratorKind::path, IntegratorKind::ambient}) {
    const Image truth = rendered(lit_scene(exact), kind);
    const Image flat = rendered(lit_scene(mesh_object(ball)), kind);
    const Image smooth =
        rendered(lit_scene(mesh_object(ball, look_with(normals_of_ball(ball)))), kind);
    EXPECT_LT(mean_difference(truth, smooth), 0.006);
    EXPECT_GT(mean_difference(truth, flat), 0.03);
  }
}

/// Rays at a coarse ball whose radiance is not that of its interpolated normal, near the terminator
/// and elsewhere: where triangles shade what their normals show as lit.
int rays_off_the_cosine(const Scene& scene, const Surface& ball, const MeshAttributes& normals,
                        IntegratorKind kind) {
  const World world = make_world(scene);
  const Integrator integrator(scene, world, {.bounces = 0, .kind = kind, .max_depth = 1});
  const TriangleMesh mesh = ball.mesh();
  const Vec3<double> to_light =
      -unit<double>(std::get<DirectionalLight>(scene.lights[0]).direction);
  int off = 0, seen = 0;
  for (int i = 0; i < 10000; ++i) {
    const Ray<double> ray{{i % 100 / 50.0 - 0.99, -5, i / 100 / 50.0 - 0.99}, {0, 1, 0}};
    PartCounts counts;
    const PartHit hit = closest_part(mesh, ray, 0, counts);
    if (!hit.found()) continue;
    const Vec3<double> n = mesh_point(mesh, normals, hit.part, ray.at(hit.t)).normal;
    if (n.y() > -0.1) continue;  // bent to be seen
    TracedRay traced{ray, Sampler(1, 0, 0, static_cast<std::uint32_t>(i))};
    RayCounts of_rays;
    integrator.trace({&traced, 1}, of_rays);
    const double expected = 3 / std::numbers::pi * std::max(0.0, n.dot(to_light));
    off += std::abs(traced.radiance.x() - expected) > 1e-9 ? 1 : 0;
    ++seen;
  }
  EXPECT_GT(seen, 5000);
  return off;
}

TEST(MeshShading, triangles_do_not_shade_what_their_normals_show_as_lit) {
  const Surface ball = coarse_ball(12, 20);
  const MeshAttributes normals = normals_of_ball(ball);
  Scene scene = lit_scene(mesh_object(ball, look_with(normals)));
  for (const IntegratorKind kind : {IntegratorKind::path, IntegratorKind::ambient})
    for (const Vec3<double>& light :
         {Vec3<double>(-0.5, 1, -0.4), Vec3<double>(1, 0.1, 0), Vec3<double>(0.3, 0, -1)}) {
      scene.lights = {DirectionalLight{light, Colour::Constant(3)}};
      EXPECT_EQ(rays_off_the_cosine(scene, ball, normals, kind), 0);
    }
}

TEST(MeshShading, normals_go_with_poses_that_stretch_and_mirror) {
  Object exact;
  exact.name = "ball";
  exact.shape = Sphere{1};
  exact.pose.linear = Vec3<double>(-0.6, 0.8, 1.2).asDiagonal();
  exact.shape = Transform{exact.shape, exact.pose};
  const Affine<double> pose = std::exchange(exact.pose, {});
  const Surface ball = coarse_ball(12, 20);
  Object mesh = mesh_object(ball, look_with(normals_of_ball(ball)));
  mesh.pose = pose;
  const Image truth = rendered(lit_scene(exact), IntegratorKind::path);
  const auto off = [&] {
    return mean_difference(truth, rendered(lit_scene(mesh), IntegratorKind::path), 11, 21);
  };
  EXPECT_LT(off(), 0.008);
  mesh.look = nullptr;
  EXPECT_GT(off(), 0.03);
}

TEST(MeshShading, normals_to_the_other_side_are_turned) {
  const Surface ball = coarse_ball(12, 20);
  MeshAttributes inwards = normals_of_ball(ball);
  for (Vec3<float>& normal : inwards.normals) normal = -normal;
  const auto of = [&](MeshAttributes attributes) {
    return rendered(lit_scene(mesh_object(ball, look_with(std::move(attributes)))),
                    IntegratorKind::path);
  };
  EXPECT_EQ(of(std::move(inwards)).pixels, of(normals_of_ball(ball)).pixels);
}

TEST(MeshShading, pictures_are_equal_for_any_number_of_threads) {
  const Surface ball = coarse_ball(12, 20);
  const Scene scene = lit_scene(mesh_object(ball, look_with(normals_of_ball(ball))));
  for (const IntegratorKind kind : {IntegratorKind::path, IntegratorKind::ambient})
    EXPECT_EQ(rendered(scene, kind, 1).pixels, rendered(scene, kind, 3).pixels);
}

TEST(MeshShading, no_light_comes_through_from_behind) {
  // A triangle that is lit from behind, with normals that lean towards the light.
  Surface triangle{{{-2, 0, -2}, {2, 0, -2}, {0, 0, 2}}, {{0, 1, 2}}};
  MeshAttributes leaning;
  leaning.normals = {attribute_normal({0, -0.2, 1})};
  leaning.normal_of = {{0, 0, 0}};
  Scene scene = lit_scene(mesh_object(triangle, look_with(leaning)));
  scene.lights = {DirectionalLight{Vec3<double>(0, -0.5, -1), Colour::Constant(3)}};
  for (const IntegratorKind kind : {IntegratorKind::path, IntegratorKind::ambient})
    for (const Vec3<float>& pixel : rendered(scene, kind).pixels) EXPECT_EQ(pixel.x(), 0.0F);
  scene.lights = {DirectionalLight{Vec3<double>(0, 0.5, -1), Colour::Constant(3)}};
  EXPECT_GT(rendered(scene, IntegratorKind::path).pixels[30 * 60 + 30].x(), 0.5F);
}

/// A square from -1 to 1 that faces the camera.
Surface square_surface() {
  return {{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
}

Colour pixel_at(const Image& image, int x, int y) {
  return image.pixels[static_cast<std::size_t>(y * image.width + x)].cast<double>();
}

TEST(MeshShading, materials_go_with_triangles) {
  MeshAttributes parts;
  parts.material_of = {1, MeshAttributes::none};
  Scene scene = lit_scene(mesh_object(square_surface(), look_with(parts, {2, 1})));
  scene.materials = {{"red", LambertMaterial{{1, 0, 0}}},
                     {"lamp", EmissiveMaterial{{0, 0, 2}}},
                     {"unused", LambertMaterial{{0, 1, 0}}}};
  for (const IntegratorKind kind : {IntegratorKind::path, IntegratorKind::ambient}) {
    const Image image = rendered(scene, kind);
    EXPECT_EQ(pixel_at(image, 38, 38), Colour(0, 0, 2));  // at the lower right
    EXPECT_GT(pixel_at(image, 22, 22).x(), 0.3);
    EXPECT_LT(pixel_at(image, 22, 22).z(), 0.3);
  }
}

TEST(MeshShading, pictures_lie_where_coordinates_put_them) {
  // Four colours: red and green above, blue and white below.
  Image image(2, 2);
  image.pixels = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  MeshAttributes parts;
  parts.uvs = {{0.25F, 0.75F}, {0.75F, 0.75F}, {0.75F, 0.25F}, {0.25F, 0.25F}};
  parts.uv_of = {{0, 1, 2}, {0, 2, 3}};
  Scene scene = lit_scene(mesh_object(square_surface(), look_with(parts)));
  scene.materials = {{"picture", LambertMaterial{Paint(ImageTexture{
                                     {"p.png", std::make_shared<const Image>(image)}, {"uv"}})}}};
  const Image seen = rendered(scene, IntegratorKind::path);
  // Pixel centres of the picture lie in the square's corners.
  const auto part = [&](int x, int y) {
    return Colour(pixel_at(seen, x, y) / pixel_at(seen, x, y).sum());
  };
  EXPECT_GT(part(10, 10).x(), 0.8);
  EXPECT_GT(part(48, 10).y(), 0.8);
  EXPECT_GT(part(10, 48).z(), 0.8);
  EXPECT_NEAR(part(48, 48).x(), 1.0 / 3, 0.1);
  // A tint multiplies, and triangles without coordinates have the mean.
  parts.uv_of[1] = MeshAttributes::no_numbers;
  scene = lit_scene(mesh_object(square_surface(), look_with(parts)));
  scene.materials = {
      {"picture", LambertMaterial{Paint(ImageTexture{
                      {"p.png", std::make_shared<const Image>(image)}, {"uv"}, 1, {0, 1, 1}})}}};
  const Image tinted = rendered(scene, IntegratorKind::path);
  EXPECT_EQ(pixel_at(tinted, 10, 10).x(), 0);
  EXPECT_GT(pixel_at(tinted, 10, 10).y(), 0);
}

TEST(MeshPoint, weights_follow_the_point_and_slopes_are_those_of_the_coordinates) {
  const Surface surface{{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}, {{0, 1, 2}}};
  const TriangleMesh mesh = surface.mesh();
  MeshAttributes made;
  made.uvs = {{0, 0}, {1, 0}, {0, 1}};
  made.uv_of = {{0, 1, 2}};
  made.normals = {attribute_normal({0, 0, 1}), attribute_normal({1, 0, 0}),
                  attribute_normal({0, 1, 0})};
  made.normal_of = {{0, 1, 2}};
  const MeshPoint found = mesh_point(mesh, made, 0, {1, 0.75, 0});
  EXPECT_LT((found.uv - Vec3<double>(0.5, 0.25, 0)).norm(), 1e-15);
  EXPECT_LT((found.uv_slopes[0] - Vec3<double>(0.5, 0, 0)).norm(), 1e-15);
  EXPECT_LT((found.uv_slopes[1] - Vec3<double>(0, 1.0 / 3, 0)).norm(), 1e-15);
  EXPECT_LT((found.normal - Vec3<double>(0.5, 0.25, 0.25).normalized()).norm(), 1e-6);
  // Outside of the triangle weights stay those of its edge.
  EXPECT_LT((mesh_point(mesh, made, 0, {5, -1, 0}).uv - Vec3<double>(1, 0, 0)).norm(), 1e-15);
  EXPECT_FALSE(mesh_point(mesh, {}, 0, {0, 0, 0}).has_uv);
}

TEST(MeshPoint, normals_are_bent_only_until_they_are_seen) {
  const Vec3<double> down(0, 0, -1), seen = Vec3<double>(1, 0, 1).normalized();
  EXPECT_EQ(seen_normal(seen, down, false), seen);
  const Vec3<double> hidden = Vec3<double>(1, 0, -0.1).normalized();
  const Vec3<double> bent = seen_normal(hidden, down, false);
  EXPECT_NEAR(bent.z(), least_seen_cosine, 1e-3);
  EXPECT_EQ(seen_normal(-seen, down, true), -seen);
}

// Glass by triangles with the ball's normals bends light as the ball does: a lamp behind it is seen
// upside down in both.
TEST(MeshShading, closed_meshes_are_glass) {
  const auto with = [](Object body) {
    Scene scene = lit_scene(std::move(body));
    scene.lights = {};
    scene.materials = {{"glass", DielectricMaterial{}}, {"lamp", EmissiveMaterial{Colour::Ones()}}};
    Object lamp;
    lamp.name = "lamp";
    lamp.shape = Box{{4, 0.1, 2}};
    lamp.pose.translation = {0, 6, 2.2};
    lamp.material = 1;
    scene.objects.push_back(lamp);
    return rendered(scene, IntegratorKind::path, 1, 64);
  };
  Object exact;
  exact.name = "ball";
  exact.shape = Sphere{1};
  const Surface ball = coarse_ball(40, 60);
  const Image truth = with(exact),
              smooth = with(mesh_object(ball, look_with(normals_of_ball(ball)))),
              flat = with(mesh_object(ball));
  double of_smooth = 0, of_flat = 0;
  for (int y = 18; y < 42; ++y)
    for (int x = 18; x < 42; ++x) {
      of_smooth += std::abs(pixel_at(truth, x, y).x() - pixel_at(smooth, x, y).x());
      of_flat += std::abs(pixel_at(truth, x, y).x() - pixel_at(flat, x, y).x());
    }
  EXPECT_GT(pixel_at(truth, 30, 40).x(), 0.5);
  EXPECT_LT(pixel_at(truth, 30, 20).x(), 0.5);
  EXPECT_LT(of_smooth / 576, 0.05);
  EXPECT_LT(of_smooth, of_flat);
}

}  // namespace
}  // namespace minkray
