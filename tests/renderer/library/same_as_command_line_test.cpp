// SPDX-License-Identifier: MIT
// The library answers what `minkray cast` answers, bit for bit.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "tests/renderer/library/errors.h"
#include "tests/renderer/library/rays.h"
#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace {

namespace mk = minkray;

/// The number after a key; the first of a list. Null is a bound that there is none of.
double number_after(const std::string& line, const std::string& key) {
  const std::size_t at = line.find("\"" + key + "\":");
  if (at == std::string::npos) return std::numeric_limits<double>::quiet_NaN();
  const char* text = line.c_str() + at + key.size() + 3;
  if (*text == 'n') return std::numeric_limits<double>::infinity();
  return std::strtod(text + (*text == '['), nullptr);
}

/// Casts rays around a point of a built-in scene with the library and on the command line, and
/// compares the results. Returns the number of hits.
std::size_t compare_rays(const std::string& name, const mk::Vec3& middle, double size) {
  const minkray::TemporaryFolder folder;
  const std::string scene_file = (minkray::source_folder() / "scenes" / name).string();
  mk::Scene scene;
  scene.add_file(scene_file);
  scene.commit();
  const std::vector<mk::Ray> rays = rays_around(middle, size, 3000);
  std::vector<mk::Hit> hits(rays.size());
  scene.cast(rays, hits);

  std::ofstream queries(folder / "queries.jsonl");
  for (const mk::Ray& ray : rays) {
    char line[1024];
    std::snprintf(line, sizeof line,
                  R"({"scene": "%s", "ray": {"origin": [%.17g, %.17g, %.17g], )"
                  R"("direction": [%.17g, %.17g, %.17g]}})"
                  "\n",
                  scene_file.c_str(), ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
                  ray.direction.y, ray.direction.z);
    queries << line;
  }
  queries.close();
  const minkray::ProgramOutcome outcome = minkray::run_minkray("cast " + folder / "queries.jsonl");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream answers(outcome.out);
  std::string line;
  std::size_t met = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!std::getline(answers, line)) {
      ADD_FAILURE() << "only " << i << " answers";
      break;
    }
    const char* names[] = {"hit", "miss", "inside", "exhausted"};
    EXPECT_TRUE(has(line, "\"status\":\"" + std::string(names[hits[i].status]) + "\""));
    if (!hits[i].found()) continue;
    ++met;
    EXPECT_EQ(hits[i].t, number_after(line, "t")) << line;
    EXPECT_EQ(hits[i].t_lo, number_after(line, "t_lo")) << line;
    EXPECT_EQ(hits[i].t_hi, number_after(line, "t_hi")) << line;
    EXPECT_EQ(hits[i].normal.x, number_after(line, "normal")) << line;
    EXPECT_EQ(double(hits[i].object), number_after(line, "object")) << line;
  }
  return met;
}

TEST(Library, answers_what_the_command_line_answers) {
  EXPECT_GT(compare_rays("shape-zoo.json", {0, 0, 1}, 6), 500u);
}

TEST(Library, reads_files_of_version_two_as_the_command_line_does) {
  EXPECT_GT(compare_rays("cafe.json", {0, 0, 0.5}, 1), 500u);
}

/// A turning beam and a ball. Bodies turn about the origin of their frame, which is the
/// pose's translation; a transform within the shape does not move the frame.
TEST(Library, turns_bodies_about_the_same_point_as_the_command_line) {
  const mk::Shape ball = mk::sphere(0.5), beam = mk::box({3, 0.1, 0.1});
  const mk::Pose at_ball = mk::translation({4, 2, 0}), at_beam = mk::translation({4, 0, 0});
  const mk::Twist turn{{}, {0, 0, 0.5}};
  const auto impact = [&](const std::string& pivot) {
    const minkray::TemporaryFolder folder;
    std::ofstream(folder / "query.jsonl")
        << R"({"query": "impact", "t_max": 10, "a": {"type": "transform", "translate": [4, 2, 0],)"
        << R"( "shape": {"type": "sphere", "radius": 0.5}}, "b": {"type": "transform",)"
        << R"( "translate": [4, 0, 0], "shape": {"type": "box", "half_extents": [3, 0.1, 0.1]}},)"
        << R"( "motion_b": {"turn": [0, 0, 0.5])" << pivot << "}}\n";
    const minkray::ProgramOutcome outcome = minkray::run_minkray("cast " + folder / "query.jsonl");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  const auto expect_same = [](const mk::Impact& found, const std::string& line) {
    ASSERT_EQ(found.status, mk::impact);
    EXPECT_TRUE(has(line, "\"status\":\"hit\""));
    EXPECT_NEAR(found.t_lo, number_after(line, "t_lo"), 1e-8) << line;
    EXPECT_NEAR(found.t_hi, number_after(line, "t_hi"), 1e-8) << line;
    EXPECT_NEAR(found.point_b.x, number_after(line, "point_b"), 1e-7) << line;
  };
  const mk::Impact about_origin = mk::time_of_impact(mk::transformed(ball, at_ball), {}, {},
                                                     mk::transformed(beam, at_beam), {}, turn, 10);
  expect_same(about_origin, impact(""));
  const mk::Impact about_middle = mk::time_of_impact(ball, at_ball, {}, beam, at_beam, turn, 10);
  expect_same(about_middle, impact(R"(, "pivot": [4, 0, 0])"));
  // The beam's side meets the ball where the distance of their middle lines is 0.6, at length 2.
  EXPECT_NEAR(about_middle.t_hi, 2 * std::acos(0.3), 1e-8);
  EXPECT_LT(about_origin.t_hi, 1);
}

}  // namespace
