// SPDX-License-Identifier: MIT
// Objects whose mesh is split into parts with hulls of their own.
#include <gtest/gtest.h>

#include <fstream>

#include "renderer/scene_json/scene_json.h"
#include "renderer/scene_json/write_scene.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

constexpr const char* tetrahedra =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 10 0 0\nv 11 0 0\nv 10 1 0\nv 10 0 1\n"
    "g all\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\nf 5 6 7\nf 5 6 8\nf 5 7 8\ng last\nf 6 7 8\n";

std::string scene_of_object(const std::string& object) {
  return R"({"version": 1, "camera": {"position": [0, -20, 0], "look_at": [0, 0, 0]}, "lights": [],
    "materials": [{"name": "grey", "type": "lambert", "color": [0.5, 0.5, 0.5]}],
    "objects": [{"name": "m", "material": "grey", )" +
         object + "}]}";
}

class Split : public ::testing::Test {
 protected:
  Split() { std::ofstream(folder_ / "two.OBJ") << tetrahedra; }

  std::optional<Scene> read(const std::string& object) {
    mistakes_ = Mistakes("s.json");
    return parse_scene(scene_of_object(object), folder_ / "", mistakes_);
  }
  TemporaryFolder folder_;
  Mistakes mistakes_{"s.json"};
};

TEST_F(Split, makes_an_object_of_each_part) {
  const std::string shape = R"("shape": {"type": "hull", "file": "two.OBJ"})";
  const auto whole = read(shape);
  ASSERT_TRUE(whole) << mistakes_.text();
  EXPECT_EQ(whole->objects.size(), 1u);
  const auto pieces =
      read(shape + R"(, "split": "components", "transform": {"translate": [0, 0, 5]},
      "keys": [{"time": 0}, {"time": 1, "translate": [0, 1, 0]}])");
  ASSERT_TRUE(pieces) << mistakes_.text();
  ASSERT_EQ(pieces->objects.size(), 2u);
  const Vec3<double> x(1, 0, 0);
  EXPECT_EQ(pieces->objects[0].name, "m[0]");
  EXPECT_EQ(pieces->objects[0].shape.support(x).x(), 1);
  EXPECT_EQ(pieces->objects[1].shape.support(Vec3<double>(-x)).x(), 10);
  for (const Object& object : pieces->objects) {
    EXPECT_EQ(object.pose.translation, Vec3<double>(0, 0, 5));
    EXPECT_TRUE(object.motion.has_value());
  }
  // With groups, the last triangle alone is the second part: a flat one.
  const auto groups = read(shape + R"(, "split": "groups")");
  ASSERT_TRUE(groups) << mistakes_.text();
  ASSERT_EQ(groups->objects.size(), 2u);
  EXPECT_EQ(groups->objects[0].shape.support(x).x(), 11);
  EXPECT_NE(groups->hash, pieces->hash);
  EXPECT_NE(groups->hash, whole->hash);
  // Written, each part has points of its own.
  Mistakes mistakes("again.json");
  const auto again = parse_scene(scene_text(*pieces), "/nowhere", mistakes);
  ASSERT_TRUE(again) << mistakes.text();
  ASSERT_EQ(again->objects.size(), 2u);
  EXPECT_EQ(again->objects[1].shape.support(x).x(), 11);
}

TEST_F(Split, stands_only_beside_a_mesh_file) {
  const auto message = [&](const std::string& object) {
    EXPECT_FALSE(read(object));
    return mistakes_.text();
  };
  const std::string file = R"("shape": {"type": "hull", "file": "two.OBJ"}, )";
  EXPECT_TRUE(has(message(file + R"("split": "group")"), "did you mean \"groups\""));
  EXPECT_TRUE(has(message(file + R"("split": 3)"), "/objects/0/split"));
  EXPECT_TRUE(has(message(R"("shape": {"type": "sphere", "radius": 1}, "split": "groups")"),
                  "needs a shape"));
  EXPECT_TRUE(has(message(R"("shape": {"type": "plane"}, "split": "groups")"), "needs a shape"));
  EXPECT_TRUE(
      has(message(R"("shape": {"type": "hull", "file": "no.obj"}, "split": "groups")"), "no.obj"));
}

}  // namespace
}  // namespace minkray
