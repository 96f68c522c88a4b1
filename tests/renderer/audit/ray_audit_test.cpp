// SPDX-License-Identifier: MIT
// The proof of a picture finds what is wrong, and nothing else.
#include "renderer/audit/ray_audit.h"

#include <gtest/gtest.h>

#include "renderer/film/render.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

/// Two balls on a plate, in a row along x.
Scene row_of_balls() {
  Scene scene;
  const auto add = [&](const char* name, Shape shape, const Vec3<double>& at) {
    scene.objects.push_back({name, std::move(shape), shifted_by(at), 0});
  };
  add("near", Sphere{1}, {0, 0, 1});
  add("far", Sphere{1}, {5, 0, 1});
  add("plate", Box{{10, 10, 0.5}}, {0, 0, -0.5});
  return scene;
}

struct Audited {
  Scene scene = row_of_balls();
  World world = make_world(scene);
  RayAudit audit{scene, world};

  /// Number of failures for the results of one ray, changed by `lie`.
  template <class Lie>
  std::uint64_t failures(const Ray<double>& ray, const Lie& lie) {
    const std::uint64_t before = audit.failed(RayKind::camera);
    QueryCounts counts;
    WorldHit answer = world.closest_hit(ray, counts);
    lie(answer);
    audit.closest(RayKind::camera, ray, no_instance, answer);
    return audit.failed(RayKind::camera) - before;
  }
};

const Ray<double> along_row{{-5, 0, 1}, {1, 0, 0}};
const Ray<double> above{{-5, 0, 3}, {1, 0, 0}};
const auto no_lie = [](WorldHit&) {};

TEST(RayAudit, true_answers_are_proven) {
  Audited audited;
  EXPECT_EQ(audited.failures(along_row, no_lie), 0u);
  EXPECT_EQ(audited.failures(above, no_lie), 0u);
  // Down to where the ball is on the plate: both are met at once.
  EXPECT_EQ(audited.failures({{-3, 0, 3}, {1, 0, -1}}, no_lie), 0u);
  audited.audit.occluded(RayKind::shadow, along_row, no_instance, true);
  audited.audit.occluded(RayKind::shadow, above, no_instance, false);
  EXPECT_EQ(audited.audit.failed(RayKind::shadow), 0u);
  EXPECT_EQ(audited.audit.rays(RayKind::shadow), 2u);
}

TEST(RayAudit, an_object_that_was_overlooked_is_named) {
  Audited audited;
  QueryCounts counts;
  const WorldHit behind = audited.world.closest_hit(along_row, counts, 0);
  ASSERT_EQ(behind.instance, 1u);
  EXPECT_EQ(audited.failures(along_row, [&](WorldHit& answer) { answer = behind; }), 1u);
  EXPECT_EQ(audited.failures(along_row, [](WorldHit& answer) { answer = {}; }), 1u);
  ASSERT_EQ(audited.audit.failures().size(), 2u);
  for (const AuditFailure& failure : audited.audit.failures()) {
    EXPECT_TRUE(has(failure.message, "near"));
    EXPECT_TRUE(has(failure.query, "\"origin\":[-5.0,0.0,1.0]"));
  }
}

TEST(RayAudit, a_wrong_hit_is_found) {
  Audited audited;
  EXPECT_EQ(audited.failures(along_row, [](WorldHit& answer) { answer.cast.t_offset += 1e-9; }),
            1u);
  EXPECT_EQ(audited.failures(along_row, [](WorldHit& answer) { answer.instance = 1; }), 1u);
  audited.audit.occluded(RayKind::shadow, along_row, no_instance, false);
  audited.audit.occluded(RayKind::shadow, above, no_instance, true);
  EXPECT_EQ(audited.audit.failed(RayKind::shadow), 2u);
}

Rendering audited_picture(const Scene& scene, const World& world, Resolution resolution,
                          RayAudit& audit) {
  RenderOptions options;
  options.resolution = resolution;
  options.samples = 2;
  options.integrator.observer = &audit;
  return render(scene, world, options);
}

TEST(RayAudit, every_ray_of_a_picture_is_proven) {
  Scene scene = row_of_balls();
  scene.camera.position = {-6, 4, 4};
  scene.camera.look_at = {1, 0, 0};
  scene.materials.push_back({});
  scene.lights.push_back(DirectionalLight{{0.3, 0.2, -1}, Colour::Constant(1)});
  scene.lights.push_back(EnvironmentLight{Colour::Constant(1), Colour::Constant(1)});
  const World world = make_world(scene);
  RayAudit audit(scene, world);
  const Rendering rendering = audited_picture(scene, world, {48, 27}, audit);
  EXPECT_EQ(audit.rays(RayKind::camera), rendering.counts.camera);
  EXPECT_EQ(audit.rays(RayKind::shadow), rendering.counts.shadow);
  EXPECT_EQ(audit.rays(RayKind::ambient), rendering.counts.ambient);
  EXPECT_EQ(audit.rays(RayKind::indirect), rendering.counts.scattered + rendering.counts.mirrored);
  EXPECT_GT(audit.rays(RayKind::shadow), 500u);
  EXPECT_TRUE(audit.failures().empty()) << audit.failures().front().message;
}

TEST(RayAudit, rays_that_leave_a_mesh_are_proven_at_the_mesh_itself) {
  Scene scene;
  scene.objects.resize(1);
  scene.objects[0].name = "ring";
  scene.objects[0].mesh = testing::torus(24, 12).shared();
  scene.materials.push_back({});
  scene.camera.position = {-3, 1, 1.5};
  scene.lights.push_back(DirectionalLight{{1, 0.2, -0.3}, Colour::Constant(1)});
  scene.lights.push_back(EnvironmentLight{Colour::Constant(1), Colour::Constant(1)});
  const World world = make_world(scene);
  RayAudit audit(scene, world);
  audited_picture(scene, world, {64, 48}, audit);
  EXPECT_GT(audit.rays(RayKind::shadow), 500u);
  EXPECT_TRUE(audit.failures().empty()) << audit.failures().front().message;
  // From the inner side of the ring across its hole, and from there up.
  QueryCounts counts;
  const Ray<double> to_middle{{0, 0.01, 0.02}, {-1, 0, 0}};
  const WorldHit start = world.closest_hit(to_middle, counts);
  ASSERT_TRUE(start.found());
  const Vec3<double> at = to_middle.origin + start.cast.t() * to_middle.direction;
  for (const bool is_met : {true, false}) {
    const Ray<double> ray{at, is_met ? Vec3<double>(1, 0, 0) : Vec3<double>(0.2, 0, 1)};
    ASSERT_EQ(world.occluded(ray, counts, 0), is_met);
    audit.occluded(RayKind::shadow, ray, 0, is_met);
    EXPECT_EQ(audit.failed(RayKind::shadow), is_met ? 0u : 1u);
    audit.occluded(RayKind::shadow, ray, 0, !is_met);
    EXPECT_EQ(audit.failed(RayKind::shadow), is_met ? 1u : 2u);
  }
}

}  // namespace
}  // namespace minkray
