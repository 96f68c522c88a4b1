// SPDX-License-Identifier: MIT
// Largest reach of shapes that are compared: up to there all casts converge, and beyond that the
// user gets an error.
#include <gtest/gtest.h>

#include "renderer/compare/compare_scene.h"
#include "renderer/scene_json/scene_json.h"

namespace minkray {
namespace {

Scene scene_of(const std::string& shape) {
  const std::string text =
      R"({"version": 1, "camera": {"position": [0, -5, 1], "look_at": [0, 0, 0]},
    "lights": [], "materials": [{"name": "matt", "type": "lambert", "color": [1, 1, 1]}],
    "objects": [{"name": "body", "material": "matt", "shape": )" +
      shape + "}]}";
  Mistakes mistakes("scene");
  const std::optional<Scene> scene = parse_scene(text, "no-such-folder", mistakes);
  EXPECT_TRUE(scene.has_value()) << mistakes.text();
  return *scene;
}

TEST(LargestCompared, is_compared_without_an_answer_given_up) {
  CompareSceneOptions options;
  options.object.rays = 2000;
  for (
      const std::string shape :
      {R"({"type": "sphere", "radius": 1e306})",
       R"({"type": "box", "half_extents": [1e306, 1e306, 5e305]})",
       R"({"type": "ellipsoid", "radii": [1e306, 1e306, 5e305]})",
       R"({"type": "capsule", "radius": 5e305, "half_height": 5e305})",
       R"({"type": "hull", "points": [[1e306, 0, 0], [-1e306, 0, 0], [0, 1e306, 0], [0, 0, 1e306]]})"}) {
    const Scene scene = scene_of(shape);
    Mistakes mistakes("scene");
    find_incomparable(scene, mistakes);
    EXPECT_TRUE(mistakes.none()) << mistakes.text();
    const SceneComparison comparison = compare_scene(scene, options);
    EXPECT_EQ(comparison.violations(), 0) << shape;
    EXPECT_GT(comparison.objects.front().report.hits, 500) << shape;
  }
}

TEST(LargestCompared, what_reaches_further_is_told) {
  Mistakes mistakes("scene");
  find_incomparable(scene_of(R"({"type": "sphere", "radius": 4e307})"), mistakes);
  EXPECT_EQ(mistakes.text(),
            "scene: object \"body\": must not reach further than 1e+306 to be compared, for its "
            "rays begin three sizes away (got 4e+307)");
}

}  // namespace
}  // namespace minkray
