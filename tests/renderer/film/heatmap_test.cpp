// SPDX-License-Identifier: MIT
#include "renderer/film/heatmap.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "core/mesh/mesh_ray.h"
#include "renderer/image/colour.h"
#include "renderer/rays/camera.h"
#include "tests/support/mesh_truth.h"
#include "tests/support/messages.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

Scene two_balls() {
  Scene scene;
  scene.camera.position = {0, -5, 0};
  scene.camera.look_at = {0, 0, 0};
  scene.materials = {{"matt", LambertMaterial{}}};
  for (const double x : {-0.8, 0.8})
    scene.objects.push_back({"ball", Sphere{0.7}, shifted_by(x, 0, 0), 0});
  return scene;
}

HeatField measure(const Scene& scene, HeatChannel channel, const CastOptions& cast = {},
                  int samples = 1) {
  RenderOptions options;
  options.resolution = {60, 40};
  options.samples = samples;
  return measure_heat(scene, make_world(scene, cast), channel, options);
}

/// Uses the models: a ball's closed form costs no iteration.
CastOptions by_models() {
  const CastOptions options{&solver::jet};
  return options;
}

TEST(Heatmap, closed_forms_answer_balls_and_models_where_they_are_asked_for) {
  EXPECT_EQ(summary_of(measure(two_balls(), HeatChannel::iterations)).most, 0);
  const auto stages = [](const HeatField& field) {
    return std::set<float>(field.values.begin(), field.values.end());
  };
  EXPECT_EQ(stages(measure(two_balls(), HeatChannel::path)), std::set<float>{0});
  const HeatField models = measure(two_balls(), HeatChannel::path, by_models());
  EXPECT_EQ(stages(models), (std::set<float>{0, 1}));  // 0: no shape was cast at
  EXPECT_EQ(models.work.answered_by(Path::model), models.work.casts);
}

TEST(Heatmap, pixels_that_meet_no_box_cost_no_iteration) {
  const HeatField iterations = measure(two_balls(), HeatChannel::iterations, by_models());
  const HeatField nodes = measure(two_balls(), HeatChannel::nodes);
  const HeatField status = measure(two_balls(), HeatChannel::status);
  ASSERT_EQ(iterations.values.size(), 2400u);
  EXPECT_EQ(iterations.values.front(), 0.0f);
  EXPECT_EQ(nodes.values.front(), 1.0f);
  EXPECT_EQ(status.values.front(), 0.0f);
  const HeatSummary summary = summary_of(iterations);
  EXPECT_EQ(summary.least, 0);
  EXPECT_GE(summary.most, 1);
  EXPECT_GT(summary.mean, 0);
  EXPECT_LT(summary.mean, summary.most);
  // Hits cost iterations.
  for (std::size_t i = 0; i < status.values.size(); ++i)
    EXPECT_GE(iterations.values[i], status.values[i]);
  const HeatField averaged = measure(two_balls(), HeatChannel::nodes, {}, 16);
  EXPECT_NEAR(summary_of(averaged).mean, summary_of(nodes).mean, 0.05);
}

TEST(Heatmap, status_tells_hit_inside_and_exhausted) {
  const auto statuses = [](const HeatField& field) {
    return std::set<float>(field.values.begin(), field.values.end());
  };
  EXPECT_EQ(statuses(measure(two_balls(), HeatChannel::status)), (std::set<float>{0, 1}));

  Scene inside = two_balls();
  inside.camera.position = {0.8, 0, 0};
  EXPECT_EQ(statuses(measure(inside, HeatChannel::status)), std::set<float>{2});

  CastOptions impatient;
  impatient.solver = &solver::gjk_alone;
  impatient.max_iterations = 2;
  const HeatField field = measure(two_balls(), HeatChannel::status, impatient);
  EXPECT_TRUE(statuses(field).contains(3));
  EXPECT_GT(field.work.exhausted, 0u);
  EXPECT_TRUE(has(heat_report(field, HeatChannel::status), "exhausted"));
}

/// Each ray meets the mesh's box once. Those that hit test at least the triangle that they hit, and
/// no more than those whose boxes they meet.
TEST(Heatmap, meshes_cost_nodes_and_a_cast_per_tested_triangle) {
  const testing::Surface ring = testing::torus(24, 12);
  Scene scene = two_balls();
  EXPECT_EQ(default_channel(scene), HeatChannel::iterations);
  scene.objects.clear();
  Object object{"ring", Point(), {}, 0};
  object.mesh = ring.shared();
  scene.objects.push_back(object);
  scene.camera.position = {0, -3, 3};
  EXPECT_EQ(default_channel(scene), HeatChannel::nodes);
  const HeatField casts = measure(scene, HeatChannel::casts),
                  nodes = measure(scene, HeatChannel::nodes),
                  status = measure(scene, HeatChannel::status);
  const Camera camera(scene.camera, {60, 40});
  const testing::MeshTruth truth(ring, {});
  std::size_t hits = 0, passes = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * 60 + static_cast<std::size_t>(x);
      const Ray<double> ray = camera.ray(x + 0.5, y + 0.5);
      std::size_t met = 0;
      PartCounts counts;
      walk_triangles(*object.mesh, ray, counts, [&](std::uint32_t, SlabRay&) {
        ++met;
        return false;
      });
      const bool is_hit = truth.first_hit(ray).found();
      ASSERT_EQ(status.values[i], is_hit ? 1.0f : 0.0f) << x << ' ' << y;
      ASSERT_GE(casts.values[i], is_hit ? 1.0f : 0.0f);
      ASSERT_LE(casts.values[i], static_cast<float>(met));
      ASSERT_GE(nodes.values[i], is_hit ? 2.0f : 1.0f);
      hits += is_hit ? 1 : 0;
      passes += casts.values[i] == 0.0f ? 1 : 0;
    }
  EXPECT_GT(hits, 300u);
  EXPECT_GT(passes, 300u);
  EXPECT_EQ(casts.work.casts, casts.work.answered_by(Path::filter));
}

TEST(Heatmap, the_picture_holds_every_panel_and_a_scale) {
  const HeatField field = measure(two_balls(), HeatChannel::iterations, by_models());
  const Image one = heat_picture({{"", &field}}, HeatChannel::iterations);
  EXPECT_GE(one.width, field.width);
  EXPECT_GT(one.height, field.height);
  const Image two = heat_picture({{"a", &field}, {"b", &field}}, HeatChannel::iterations);
  EXPECT_GT(two.height, one.height);
  // Something bright is drawn below the panel: the bar's upper end.
  float brightest = 0;
  for (int y = field.height; y < one.height; ++y)
    for (int x = 0; x < one.width; ++x) brightest = std::max(brightest, one.at(x, y).x());
  EXPECT_GT(brightest, 0.9f);
  const Image numbers = heat_numbers({{"a", &field}, {"b", &field}});
  EXPECT_EQ(numbers.width, 2 * field.width);
  EXPECT_EQ(numbers.at(20, 20).x(), field.values[20 * 60 + 20]);
  EXPECT_EQ(numbers.at(60 + 20, 20).x(), field.values[20 * 60 + 20]);
}

TEST(Heatmap, the_histogram_counts_every_pixel) {
  const HeatField field{4, 2, {0, 0, 3, 7, 7, 7, 120, 55}, {}, true};
  const std::string report = heat_report(field, HeatChannel::nodes);
  EXPECT_TRUE(has(report, "min 0  mean 24.875  max 120"));
  std::size_t total = 0;
  std::istringstream lines(report.substr(report.find('\n') + 1));
  for (std::string line; std::getline(lines, line);) total += std::stoul(line.substr(14));
  EXPECT_EQ(total, 8u);
}

}  // namespace
}  // namespace minkray
