// SPDX-License-Identifier: MIT
#include "renderer/scene_json/scene_json.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/json/json.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

/// Mistakes found in a text that is read as "x.json".
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
      "x.json: /objects/7/name: duplicate key",
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

TEST(SceneJson, lights_are_no_brighter_than_pictures_can_hold) {
  Mistakes mistakes("x.json");
  EXPECT_FALSE(
      parse_scene(R"({"version": 1, "camera": {"position": [0, -4, 2], "look_at": [0, 0, 0]},
    "lights": [{"type": "point", "position": [0, 0, 3], "color": [1e15, 2e15, 1]},
               {"type": "directional", "direction": [0, 0, -1], "color": [1, 1, 1],
                "intensity": 1e300}],
    "materials": [{"name": "lamp", "type": "emissive", "radiance": [1, 1, 1e16]}],
    "objects": [], "background": [0, 1e16, 0]})",
                  ".", mistakes));
  const std::string range = "must be >= 0 and <= 1e15 (got ";
  EXPECT_EQ(mistakes.text(), "x.json: /lights/0/color/1: " + range + "2e+15)\n" +
                                 "x.json: /lights/1/intensity: " + range + "1e+300)\n" +
                                 "x.json: /materials/0/radiance/2: " + range + "1e+16)\n" +
                                 "x.json: /background/1: " + range + "1e+16)");
}

TEST(SceneJson, a_file_that_cannot_be_read_says_why) {
  const auto message = [](const char* file) -> std::string {
    return message_of<BadInput>([&] { load_scene(file); });
  };
  EXPECT_EQ(message("no-such-file.json"),
            "no-such-file.json: cannot be read: No such file or directory");
  EXPECT_EQ(message("/"), "/: must be a file (got a directory)");
}

/// Whole numbers that other types than double wrap or round.
const std::vector<std::string> too_large = {
    "2147483648",           "4294967297",  "9223372036854775808",   "18446744073709551616",
    "18446744073709551617", "-4294967295", "-18446744073709551615", "1e300"};

TEST(SceneJson, whole_numbers_that_are_too_large_are_refused_and_never_wrap) {
  const std::string text(good_scene);
  const auto with = [&](const std::string& before, const std::string& after) {
    std::string changed = text;
    changed.replace(changed.find(before), before.size(), after);
    const std::vector<std::string> found = complaints(changed);
    EXPECT_EQ(found.size(), 1u) << after;
    return found.empty() ? "" : found[0];
  };
  for (const std::string& number : too_large) {
    const std::string got = "(got " + Json::parse(number).dump() + ")";
    EXPECT_EQ(with("\"version\": 1", "\"version\": " + number),
              "x.json: /version: must be 1 or 2 " + got);
    const std::string side =
        "must be a whole number from 1 to " + std::to_string(most_pixels_a_side) + " " + got;
    EXPECT_EQ(with("[320, 200]", "[" + number + ", 200]"), "x.json: /camera/resolution/0: " + side);
    EXPECT_EQ(with("[320, 200]", "[320, " + number + "]"), "x.json: /camera/resolution/1: " + side);
    const std::string start =
        R"("particles": [{"name": "p", "shape": {"type": "sphere", "radius": 1}, )";
    EXPECT_EQ(
        with("\"background\"", start + R"("material": "red", "poses": [[0, 0, 0]], "count": )" +
                                   number + "}], \"background\""),
        "x.json: /particles/0/count: must be a whole number from 1 to 2147483647 " + got);
    const std::string of_material = with(
        "\"background\"", start + R"("materials": ["red"], "columns": ["position", "material"],)" +
                              R"("poses": [[0, 0, 0, )" + number + "]]}], \"background\"");
    EXPECT_EQ(of_material.find("x.json: /particles/0/poses/0: material must be an index of the "
                               "block's materials (got "),
              0u)
        << of_material;
  }
}

TEST(SceneJson, names_of_files_reach_no_terminal_as_they_are) {
  Mistakes mistakes("c\x1b[31m\n\xff.json");
  parse_scene(R"({"version": 1, "camera": {}, "lights": [], "materials": [], "objects": [
                  {"name": "a", "material": "b",
                   "shape": {"type": "hull", "file": "d\u001b[31m\u0085e.obj"}}]})",
              "no\x9b-folder", mistakes);
  EXPECT_FALSE(mistakes.none());
  for (const std::string& message : mistakes.messages()) {
    EXPECT_EQ(message.find("c?[31m??.json: /"), 0u) << message;
    EXPECT_EQ(message, printable(message));
  }
  EXPECT_TRUE(has(mistakes.text(), "no?-folder/d?[31m?e.obj: cannot be read: "));
}

}  // namespace
}  // namespace minkray
