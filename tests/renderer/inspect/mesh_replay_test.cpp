// SPDX-License-Identifier: MIT
// Meshes in the inspector's page, compared with all triangles in long double.
#include <gtest/gtest.h>

#include <sstream>

#include "renderer/inspect/body_mesh.h"
#include "renderer/inspect/pixel_answers.h"
#include "renderer/inspect/replay_lines.h"
#include "renderer/inspect/shape_mesh.h"
#include "tests/support/mesh_truth.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

Scene scene_of(const testing::Surface& surface, const Affine<double>& pose) {
  Scene scene;
  scene.materials = {{"grey", LambertMaterial{{0.5, 0.5, 0.5}}}};
  Object object{"ring", Point(), pose, 0};
  object.mesh = surface.shared();
  scene.objects.push_back(object);
  return scene;
}

Affine<double> uneven_pose(testing::Random& random) {
  const Mat3<double> linear = random.rotation() * Vec3<double>(1.3, 0.7, 1.1).asDiagonal();
  return {linear, 0.5 * random.in_cube()};
}

Ray<double> ray_near(const Affine<double>& pose, testing::Random& random) {
  const Vec3<double> from = 4 * random.direction();
  return {from, pose.translation + random.in_cube() - from};
}

Vec3<double> vertex(const Json& mesh, std::size_t i) {
  const Json& v = mesh["v"];
  return {v[3 * i].get<double>(), v[3 * i + 1].get<double>(), v[3 * i + 2].get<double>()};
}

Vec3<double> as_vector(const Json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

std::vector<Json> lines_of(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(Json::parse(line));
  return lines;
}

TEST(MeshReplay, pixels_show_the_first_of_all_triangles) {
  const testing::Surface ring = testing::torus(14, 9);
  testing::Random random(1);
  int hits = 0, misses = 0;
  for (int i = 0; i < testing::number_of_cases(300); ++i) {
    const Affine<double> pose = uneven_pose(random);
    const Scene scene = scene_of(ring, pose);
    const SceneCasts casts(scene, {});
    const Ray<double> ray = ray_near(pose, random);
    const testing::MeshTruth truth(ring, pose);
    const testing::MeshTruth::Hit first = truth.first_hit(ray);
    const ShownCast shown = shown_cast(casts, ray, most_looked_at_alone);
    ASSERT_EQ(shown.status, first.found() ? 1 : 0) << i;
    if (!first.found()) {
      ++misses;
      EXPECT_EQ(shown.object, 0u);
      EXPECT_FALSE(shown.has_steps);
      continue;
    }
    ++hits;
    EXPECT_EQ(shown.object, 1u);
    EXPECT_TRUE(shown.has_steps);
    EXPECT_EQ(shown.part, first.triangle);
    const auto t = static_cast<double>(first.t);
    EXPECT_NEAR(shown.t, t, 1e-13);
    EXPECT_LE(shown.t - shown.below, t + 1e-15);
    EXPECT_GE(shown.t + shown.above, t - 1e-15);
    const Vec3<double> normal = truth.normal(first.triangle).cast<double>();
    EXPECT_NEAR(std::abs(shown.normal.dot(normal)), 1, 1e-12);
    EXPECT_LT(shown.normal.dot(ray.direction), 0);
  }
  EXPECT_GT(hits, 80);
  EXPECT_GT(misses, 80);
}

TEST(MeshReplay, the_last_plane_is_the_triangle_s_and_its_mesh_is_around_it) {
  const testing::Surface ring = testing::torus(14, 9);
  testing::Random random(2);
  const Affine<double> pose = uneven_pose(random);
  const Scene scene = scene_of(ring, pose);
  const SceneCasts casts(scene, {});
  const testing::MeshTruth in_mesh(ring, {});
  ReplayLines replays(fine_mesh);
  int replayed = 0;
  std::set<std::uint32_t> triangles;
  for (int i = 0; i < 200; ++i) {
    const Ray<double> ray = ray_near(pose, random);
    const auto shown = casts.shown(ray, casts.answer(ray), most_looked_at_alone);
    if (!shown) continue;
    const bool is_new = triangles.insert(shown->part).second;
    const std::vector<Json> lines = lines_of(replays.ray(casts, 0, *shown, {0.5, 0.5, ray}));
    ASSERT_EQ(lines.size(), replayed == 0 ? 3u : is_new ? 2u : 1u);
    if (replayed++ == 0) {
      const Json& body = lines[0]["mesh"];
      EXPECT_EQ(lines[0]["kind"].text(), "body");
      EXPECT_EQ(body["coarse"], false);
      ASSERT_EQ(body["t"].size(), 3 * ring.triangles.size());
      const double scale = body["scale"].get<double>();
      for (std::size_t k = 0; k < body["v"].size() / 3; ++k)
        EXPECT_LE(static_cast<double>(
                      in_mesh.distance(as_vector(body["middle"]) + scale * vertex(body, k))),
                  scale);
    }
    const Json& line = lines.back();
    EXPECT_EQ(line["triangle"].get<std::uint64_t>(), shown->part);
    const Json& steps = line["cast"]["steps"];
    ASSERT_GT(steps.size(), 0u);
    const Vec3<double> v = as_vector(steps[steps.size() - 1][5]).normalized();
    EXPECT_NEAR(std::abs(v.dot(in_mesh.normal(shown->part).cast<double>())), 1, 1e-6);
    if (!is_new) continue;
    const Json& shape = lines[lines.size() - 2]["mesh"];
    const double scale = shape["scale"].get<double>();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<double>& corner = ring.vertices[ring.triangles[shown->part][k]];
      const Vec3<double> drawn = as_vector(shape["at"]) + scale * vertex(shape["inner"], k);
      EXPECT_LE((drawn - corner).norm(), scale);
    }
  }
  EXPECT_GT(replayed, 60);
}

TEST(MeshReplay, large_meshes_are_drawn_coarsely) {
  const testing::Surface ring = testing::torus(160, 90);
  const TriangleMesh mesh = ring.mesh();
  const testing::MeshTruth truth(testing::torus(40, 24), {});
  const Json body = body_json(mesh, 1000);
  EXPECT_EQ(body["coarse"], true);
  EXPECT_LE(body["t"].size(), 3000u);
  EXPECT_GT(body["t"].size(), 1000u);
  const double scale = body["scale"].get<double>(), cell = 0.15;
  Bounds<double> box;
  for (std::size_t k = 0; k < body["v"].size() / 3; ++k) {
    const Vec3<double> at = as_vector(body["middle"]) + scale * vertex(body, k);
    box.extend(at);
    EXPECT_LE(static_cast<double>(truth.distance(at)), cell);
  }
  EXPECT_NEAR(box.upper.x(), 1.4, cell);
  EXPECT_NEAR(box.lower.z(), -0.4, cell);
}

}  // namespace
}  // namespace minkray
