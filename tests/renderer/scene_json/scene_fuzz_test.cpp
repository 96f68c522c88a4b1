// SPDX-License-Identifier: MIT
// Whatever a scene file holds, reading it ends with a scene or with messages.
#include <gtest/gtest.h>

#include <random>

#include "renderer/json/parse.h"
#include "renderer/member_json/shape_json.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/support/messages.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

/// Reads the text and checks the only two ways in which that may end.
void expect_an_end(const std::string& text, int& scenes) {
  Mistakes mistakes("fuzz");
  const auto scene = parse_scene(text, "no-such-folder", mistakes);
  EXPECT_EQ(scene.has_value(), mistakes.none()) << text;
  if (scene) ++scenes;
  for (const std::string& message : mistakes.messages()) {
    EXPECT_LT(message.size(), 700u) << message;
    EXPECT_FALSE(has(message, "\n"));
  }
}

TEST(SceneFuzz, damaged_scenes_are_read_or_refused) {
  const std::string zoo = text_of_file(source_folder() / "scenes/shape-zoo.json");
  ASSERT_GT(zoo.size(), 1000u);
  std::mt19937 random(3);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const std::vector<std::string> pieces = {
      "-",    "1e999", "NaN", "[",    "]", "{",    "}",  ",",  ":",  "\"",   "null",  "0",
      "1e30", "true",  "\\",  "\xff", "",  "[[[[", "-0", "{}", "[]", "\"\"", "1e-320"};
  int scenes = 0;
  for (int i = 0; i < 1500; ++i) {
    std::string text = zoo;
    for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
      const std::size_t at = below(text.size());
      text.replace(at, below(4), pieces[below(pieces.size())]);
    }
    expect_an_end(text, scenes);
  }
  // Some damage is none, for example within a name.
  EXPECT_GT(scenes, 10);
  EXPECT_LT(scenes, 500);
}

TEST(SceneFuzz, the_start_of_a_scene_is_no_scene) {
  const std::string zoo = text_of_file(source_folder() / "scenes/figure-1.json");
  int scenes = 0;
  for (std::size_t length = 0; length + 2 < zoo.size(); length += 7) {
    expect_an_end(zoo.substr(0, length), scenes);
  }
  EXPECT_EQ(scenes, 0);
}

/// Random JSON of the words that shapes know.
Json random_json(std::mt19937& random, int depth) {
  static const std::vector<std::string> keys = {
      "type", "radius",       "radii",  "shape",     "shapes", "a",     "b",     "points",
      "file", "half_extents", "matrix", "translate", "rotate", "scale", "bogus", "half_height"};
  static const std::vector<std::string> types = {
      "sphere",  "hull",      "rounded", "minkowski_sum", "minkowski_difference",
      "hull_of", "transform", "box",     "segment",       "nonsense"};
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  switch (depth > 6 ? below(4) : below(10)) {
    case 0:
      return -1.5;
    case 1:
      return 1;
    case 2:
      return nullptr;
    case 3:
      return types[below(types.size())];
    case 4:
    case 5: {
      Json list = Json::array();
      for (std::size_t n = below(5); n > 0; --n) list.push_back(random_json(random, depth + 1));
      return list;
    }
    default: {
      Json object = {{"type", types[below(types.size())]}};
      for (std::size_t n = below(5); n > 0; --n) {
        object[keys[below(keys.size())]] = random_json(random, depth + 1);
      }
      return object;
    }
  }
}

TEST(SceneFuzz, any_json_is_a_shape_or_a_mistake) {
  std::mt19937 random(4);
  for (int i = 0; i < 20000; ++i) {
    Mistakes mistakes("fuzz");
    MeshFiles meshes("no-such-folder");
    const auto shape = read_shape(random_json(random, 0), JsonPath(), mistakes, meshes);
    EXPECT_EQ(shape.has_value(), mistakes.none());
    if (shape) {
      EXPECT_TRUE(shape->support<double>({1, 2, 3}).allFinite());
    }
  }
}

}  // namespace
}  // namespace minkray
