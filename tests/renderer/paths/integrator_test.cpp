// SPDX-License-Identifier: MIT
// Calls of an observer while light is gathered. Pictures test the light itself
// (tests/renderer/film/render_test.cpp).
#include "renderer/paths/integrator.h"

#include <gtest/gtest.h>

#include "renderer/film/render.h"
#include "renderer/rays/camera.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

/// Two balls, one of them a mirror, on a floor, in light of every kind.
Scene two_balls() {
  Scene scene;
  scene.camera.position = {0, -6, 3};
  scene.camera.resolution = {32, 32};
  scene.lights = {DirectionalLight{{-1, 1, -2}, {2, 2, 2}}, PointLight{{1, -3, 4}, {9, 9, 9}},
                  EnvironmentLight{{0.7, 0.8, 1.0}, {0.3, 0.3, 0.3}}};
  scene.materials = {{"matt", LambertMaterial{{0.7, 0.6, 0.5}}},
                     {"shiny", GlossyMaterial{{0.2, 0.3, 0.7}, 0.2, 1.5}}};
  const auto add = [&](const char* name, Shape shape, const Vec3<double>& at,
                       std::uint32_t material) {
    scene.objects.push_back({name, std::move(shape), shifted_by(at), material});
  };
  add("floor", Box{{5, 5, 1}}, {0, 0, -2}, 0);
  add("near", Sphere{0.7}, {-0.8, -1, 0}, 1);
  add("far", Sphere{1}, {1, 1, 0}, 0);
  return scene;
}

/// Counts its calls, and queries the world again.
class Listener final : public RayObserver {
 public:
  explicit Listener(const World& world) : world_(world) {}

  void closest(RayKind kind, const Ray<double>& ray, std::uint32_t skip,
               const WorldHit& answer) override {
    ++told_[static_cast<std::size_t>(kind)];
    const WorldHit again = world_.closest_hit(ray, counts_, skip);
    EXPECT_EQ(answer.instance, again.instance);
    if (again.found()) {
      EXPECT_EQ(answer.cast.t(), again.cast.t());
    }
  }
  void occluded(RayKind kind, const Ray<double>& ray, std::uint32_t skip, bool answer) override {
    ++told_[static_cast<std::size_t>(kind)];
    EXPECT_EQ(answer, world_.occluded(ray, counts_, skip));
    blocked_ += answer ? 1 : 0;
  }

  std::uint64_t message(RayKind kind) const { return told_[static_cast<std::size_t>(kind)]; }
  std::uint64_t blocked() const { return blocked_; }

 private:
  const World& world_;
  QueryCounts counts_;
  std::array<std::uint64_t, 4> told_{};
  std::uint64_t blocked_ = 0;
};

TEST(Integrator, an_observer_is_told_of_every_ray_and_its_own_answer) {
  const Scene scene = two_balls();
  const World world = make_world(scene);
  const Camera camera(scene.camera, scene.camera.resolution);
  std::vector<TracedRay> rays;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      rays.push_back({camera.ray(x + 0.5, y + 0.5), Sampler(2, x, y, 0)});
  std::vector<TracedRay> alone = rays;
  RayCounts counts_alone;
  for (TracedRay& ray : alone)
    Integrator(scene, world, {.bounces = 2}).trace(std::span(&ray, 1), counts_alone);
  for (const std::size_t together : {1, 5, most_in_ray_group, 300, 1024}) {
    Listener listener(world);
    const Integrator integrator(scene, world, {.bounces = 2, .observer = &listener});
    std::vector<TracedRay> seen = rays;
    RayCounts counts;
    for (std::size_t first = 0; first < seen.size(); first += together)
      integrator.trace(std::span(seen).subspan(first, std::min(together, seen.size() - first)),
                       counts);
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(seen[i].radiance, alone[i].radiance);
    EXPECT_EQ(listener.message(RayKind::camera), counts.camera);
    EXPECT_EQ(listener.message(RayKind::shadow), counts.shadow);
    EXPECT_EQ(listener.message(RayKind::ambient), counts.ambient);
    EXPECT_EQ(listener.message(RayKind::indirect), counts.scattered + counts.mirrored);
    EXPECT_EQ(counts.total(), counts_alone.total());
    for (const RayKind kind :
         {RayKind::camera, RayKind::shadow, RayKind::ambient, RayKind::indirect})
      EXPECT_GT(listener.message(kind), 50u);
    EXPECT_GT(listener.blocked(), 50u);
  }
}

}  // namespace
}  // namespace minkray
