// SPDX-License-Identifier: MIT
// Objects that are meshes, in scene files.
#include <gtest/gtest.h>

#include <fstream>

#include "core/mesh/triangle_mesh.h"
#include "renderer/scene/scene_json.h"
#include "renderer/scene/summary.h"
#include "renderer/scene/write_scene.h"
#include "tests/support/temporary_folder.h"

namespace minkray {
namespace {

class MeshJson : public ::testing::Test {
 protected:
  MeshJson() {
    std::ofstream(folder_ / "two.obj")
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 1 1 0\nf 1 2 3\nf 2 5 3\nf 4 5 3\n";
    std::ofstream(folder_ / "points.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  }

  std::optional<Scene> read(const std::string& object) {
    mistakes_ = Mistakes("s.json");
    return parse_scene(
        R"({"version": 1, "camera": {"position": [0, -20, 0], "look_at": [0, 0, 0]}, "lights": [],
        "materials": [{"name": "grey", "type": "lambert", "color": [0.5, 0.5, 0.5]}],
        "objects": [{"name": "m", "material": "grey", )" +
            object + "}]}",
        folder_ / "", mistakes_);
  }
  std::string wrong(const std::string& object) {
    EXPECT_FALSE(read(object));
    return mistakes_.text();
  }
  TemporaryFolder folder_;
  Mistakes mistakes_{"s.json"};
};

TEST_F(MeshJson, are_read_of_files_once_and_scaled) {
  const auto scene = read(R"("mesh": {"file": "two.obj", "scale": 0.5}}, {"name": "n",
    "material": "grey", "mesh": {"scale": 0.5, "file": "two.obj"})");
  ASSERT_TRUE(scene) << mistakes_.text();
  const Object& object = scene->objects[0];
  ASSERT_TRUE(object.mesh);
  EXPECT_EQ(object.mesh->size(), 3u);
  EXPECT_EQ(object.mesh->vertices().size(), 4u);  // the fourth is the first again
  EXPECT_EQ(object.mesh->bounds().upper, Vec3<double>(0.5, 0.5, 0));
  EXPECT_EQ(object.mesh, scene->objects[1].mesh);
  const SceneSummary summary = summarise(*scene);
  ASSERT_EQ(summary.kinds.size(), 1u);
  EXPECT_EQ(summary.kinds[0].name, "mesh");
  EXPECT_EQ(summary.bounds.upper.x(), 0.5);
}

TEST_F(MeshJson, are_written_and_read_again) {
  const auto scene = read(
      R"("mesh": {"vertices": [[0, 0, 0.1], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
      "triangles": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]})");
  ASSERT_TRUE(scene) << mistakes_.text();
  Mistakes mistakes("again.json");
  const auto again = parse_scene(scene_text(*scene), folder_ / "", mistakes);
  ASSERT_TRUE(again) << mistakes.text();
  const TriangleMesh &a = *scene->objects[0].mesh, &b = *again->objects[0].mesh;
  EXPECT_TRUE(std::ranges::equal(a.vertices(), b.vertices()));
  EXPECT_TRUE(std::ranges::equal(a.triangles(), b.triangles()));
}

TEST_F(MeshJson, tell_what_is_wrong) {
  EXPECT_EQ(wrong(R"("mesh": {"file": "two.obj"}, "shape": {"type": "sphere", "radius": 1})"),
            "s.json: /objects/0/shape: must not be given beside \"mesh\"");
  EXPECT_EQ(wrong(R"("mesh": {"file": "two.obj", "scale": 0})"),
            "s.json: /objects/0/mesh/scale: must be > 0 (got 0)");
  EXPECT_NE(wrong(R"("mesh": {"file": "points.obj"})").find("must have faces"), std::string::npos);
  EXPECT_NE(wrong(R"("mesh": {"file": "none.obj"})").find("none.obj"), std::string::npos);
  const std::string vertices = R"("mesh": {"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]])";
  EXPECT_EQ(wrong(vertices + "}"),
            "s.json: /objects/0/mesh/triangles: missing: must be a list of three numbers of "
            "vertices each");
  EXPECT_EQ(wrong(vertices + R"(, "triangles": [[0, 1, 3]]})"),
            "s.json: /objects/0/mesh: triangles[0]: must be numbers of vertices, less than 3 (got "
            "3)");
  EXPECT_EQ(wrong(vertices + R"(, "triangles": [[0, 1]]})"),
            "s.json: /objects/0/mesh/triangles/0: must be a list of three numbers of vertices (got "
            "a list of 2)");
  EXPECT_EQ(wrong(vertices + R"(, "triangles": [[0, 1, -2]]})"),
            "s.json: /objects/0/mesh/triangles/0: must be a list of three numbers of vertices (got "
            "a list of 3)");
}

}  // namespace
}  // namespace minkray
