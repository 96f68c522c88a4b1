// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "renderer/claims/claim.h"
#include "renderer/claims/panels.h"
#include "renderer/claims/trace_picture.h"
#include "renderer/paper/distance.h"
#include "tests/support/messages.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST(Panels, show_every_iteration_of_a_real_run_with_its_discarded_vertices) {
  const Shape polygon = Hull{PointCloud(
      {Vec3<double>(1, 0.2, 0), {2, -1, 0}, {4, 0, 0}, {4, 2, 0}, {2.5, 3, 0}, {1.2, 2, 0}})};
  const Shape disk = Transform{Nested(Disk{0.5}), shifted_by(-1, -1, 0)};
  DistanceResult<double, 2> result;
  const std::string svg = distance_panels_svg(polygon, disk, SubalgorithmKind::projection, result);
  EXPECT_EQ(result.status, DistanceStatus::separated);
  // The vertex (1, 0.2) is closest to the disk.
  EXPECT_NEAR(result.distance, Vec3<double>(2, 1.2, 0).norm() - 0.5, 1e-14);
  EXPECT_EQ(count(svg, "k = "), static_cast<std::size_t>(result.iterations));
  EXPECT_EQ(count(svg, "<g "), count(svg, "</g>"));
  EXPECT_FALSE(has(svg, "nan"));
}

TEST(Trace, tables_and_pictures_have_a_line_for_each_iteration) {
  const PreparedShape shape(Shape(Cone{0.7, 0.5}));
  const CastOptions options{&solver::gjk_alone};
  const CastTrace trace = trace_ray(shape, {{-3, 0.2, 0.1}, {1, 0.01, -0.02}}, options);
  ASSERT_EQ(trace.result.status, Status::hit);
  ASSERT_EQ(trace.iterations.size(), static_cast<std::size_t>(trace.result.iterations));
  const std::string table = trace_table(trace);
  EXPECT_EQ(count(table.substr(0, table.find("k: iteration")), "\n"), trace.iterations.size() + 1);
  EXPECT_TRUE(has(table, "t_lo, t_hi: bounds of t"));  // a legend
  const std::string svg = trace_svg(trace, shape);
  EXPECT_EQ(count(svg, ">p"), trace.iterations.size());
  EXPECT_FALSE(has(svg, "nan,"));
  // The bounds close in on the hit from both sides.
  for (const auto& step : trace.iterations) {
    EXPECT_LE(trace.t(step.lower), trace.result.t() + 1e-14);
    EXPECT_GE(trace.t(step.upper), trace.result.t() - 1e-14);
  }
}

TEST(Paper, a_spheres_iterations_are_a_line_in_the_tolerances_logarithm) {
  ClaimOptions options;
  options.rays = 500;
  const ClaimResult result = sphere_iterations(options);
  EXPECT_EQ(result.verdict.rfind("confirmed", 0), 0u) << result.verdict;
  ASSERT_EQ(result.plots.size(), 1u);
  EXPECT_TRUE(has(plot_svg(result.plots[0]), "</svg>"));
}

TEST(Paper, caching_the_separating_axis_saves_iterations) {
  const ClaimResult result = cached_axis({});
  EXPECT_EQ(result.verdict.rfind("confirmed", 0), 0u) << result.verdict;
}

TEST(Paper, caching_features_saves_supports_in_our_own_queries_and_changes_no_contact) {
  const ClaimResult result = caching_in_own_queries({});
  EXPECT_EQ(result.verdict.rfind("confirmed", 0), 0u) << result.verdict;
  EXPECT_EQ(result.ours.size(), 2u) << "contacts differ";
}

TEST(Paper, in_single_precision_no_cast_loops) {
  ClaimOptions options;
  options.rays = 300;
  EXPECT_EQ(float_terminates(options).verdict.rfind("confirmed", 0), 0u);
}

}  // namespace
}  // namespace minkray
