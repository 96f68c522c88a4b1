// SPDX-License-Identifier: MIT
#include "renderer/scene/scene_json.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace minkray {
namespace {

/// What reading a text as "x.json" complains about.
std::vector<std::string> complaints(std::string_view text) {
  Mistakes mistakes("x.json");
  const auto scene = parse_scene(text, "no-such-folder", mistakes);
  EXPECT_EQ(scene.has_value(), mistakes.none());
  return mistakes.messages();
}

constexpr std::string_view good_scene = R"({
  "version": 1,
  "description": "A ball over a plate.",
  "camera": {"position": [0, -4, 2], "look_at": [0, 0, 0], "fov_y_degrees": 35,
             "resolution": [320, 200]},
  "lights": [{"type": "directional", "direction": [1, 1, -2], "color": [1, 0.5, 0.25],
              "intensity": 2},
             {"type": "environment", "zenith": [0.4, 0.5, 0.6], "nadir": [0.1, 0.1, 0.1]}],
  "materials": [{"name": "red", "type": "lambert", "color": [0.8, 0.1, 0.1]},
                {"name": "coat", "type": "glossy", "color": [0.2, 0.2, 0.2], "roughness": 0}],
  "objects": [
    {"name": "ball", "shape": {"type": "sphere", "radius": 0.5}, "material": "coat",
     "transform": {"translate": [0, 0, 1], "scale": [1, 2, 3]}},
    {"name": "plate", "shape": {"type": "box", "half_extents": [2, 2, 0]}, "material": "red"}],
  "background": [0.5, 0.6, 0.7]
})";

TEST(SceneJson, a_good_scene_is_read_as_it_is_written) {
  Mistakes mistakes("x.json");
  const auto scene = parse_scene(good_scene, ".", mistakes);
  ASSERT_TRUE(scene) << mistakes.text();
  EXPECT_EQ(scene->description, "A ball over a plate.");
  EXPECT_EQ(scene->camera.resolution.width, 320);
  EXPECT_EQ(scene->camera.up, Vec3<double>(0, 0, 1));
  ASSERT_EQ(scene->lights.size(), 2u);
  EXPECT_EQ(std::get<DirectionalLight>(scene->lights[0]).colour, Colour(2, 1, 0.5));
  EXPECT_EQ(std::get<EnvironmentLight>(scene->lights[1]).zenith, Colour(0.4, 0.5, 0.6));
  ASSERT_EQ(scene->objects.size(), 2u);
  EXPECT_EQ(scene->materials[scene->objects[0].material].name, "coat");
  EXPECT_EQ(scene->objects[0].pose(Vec3<double>(0, 0.5, 0)), Vec3<double>(0, 1, 1));
  EXPECT_EQ(scene->background.nadir, Colour(0.5, 0.6, 0.7));
  EXPECT_FALSE(scene->labels);
}

TEST(SceneJson, ten_different_mistakes_get_ten_messages_with_their_places) {
  const std::vector<std::string> found = complaints(R"({
    "version": 1,
    "camera": {"position": [0, -4, "two"], "look_at": [0, 0, 0], "fov_y_degrees": 200},
    "lights": [{"type": "directional", "direction": [1, 1, NaN]}],
    "materials": [{"name": "red", "type": "lambert", "color": [0.8, 0.1, 0.1]}],
    "objects": [
      {"name": "a", "shape": {"type": "sphere", "radius": -1}, "material": "red"},
      {"name": "b", "shape": {"type": "sphere", "radus": 1}, "material": "red"},
      {"name": "c", "shape": {"type": "bxo", "half_extents": [1, 1, 1]}, "material": "red"},
      {"name": "d", "shape": {"type": "hull", "file": "none.obj"}, "material": "red"},
      {"name": "e", "shape": {"type": "transform", "shape": {"type": "sphere", "radius": 1},
                              "matrix": [[1, 2, 3], [2, 4, 6], [0, 0, 1]]}, "material": "red"},
      {"name": "f", "shape": {"type": "sphere", "radius": 1e999}, "material": "rde"},
      {"name": "g", "shape": {"type": "hull_of", "shapes": []}, "material": "red"},
      {"name": "h", "shape": {"type": "box", "half_extents": [1, 1]}, "material": "red",
       "name": "i"}
    ]
  })");
  const std::vector<std::string> expected = {
      "x.json: /lights/0/direction/2: must be a finite number (got NaN)",
      "x.json: /objects/5/shape/radius: must be a finite number (got 1e999)",
      "x.json: /objects/7/name: key given twice",
      "x.json: /camera/position/2: must be a number (got \"two\")",
      "x.json: /camera/fov_y_degrees: must be > 0 and < 180 (got 200)",
      "x.json: /objects/0/shape/radius: must be > 0 (got -1)",
      "x.json: /objects/1/shape/radius: missing: must be its radius, > 0",
      "x.json: /objects/1/shape/radus: unknown key (did you mean \"radius\"?)",
      "x.json: /objects/2/shape/type: must be the name of a shape (got \"bxo\"; did you mean "
      "\"box\"?)",
      "x.json: /objects/3/shape/file: no-such-folder/none.obj: cannot be read: No such file or "
      "directory",
      "x.json: /objects/4/shape/matrix: must be invertible (got a singular matrix "
      "[[1,2,3],[2,4,6],[0,0,1]])",
      "x.json: /objects/5/material: must be the name of a material (got \"rde\"; did you mean "
      "\"red\"?)",
      "x.json: /objects/6/shape/shapes: must be a list of shapes, at least 1 (got a list of 0)",
      "x.json: /objects/7/shape/half_extents: must be a list of 3 numbers (got a list of 2)",
  };
  EXPECT_EQ(found, expected);
}

TEST(SceneJson, a_file_that_cannot_be_read_says_why) {
  const auto message = [](const char* file) -> std::string {
    try {
      load_scene(file);
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return "";
  };
  EXPECT_EQ(message("no-such-file.json"),
            "no-such-file.json: cannot be read: No such file or directory");
  EXPECT_EQ(message("/"), "/: must be a file (got a directory)");
}

}  // namespace
}  // namespace minkray
