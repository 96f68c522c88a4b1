// SPDX-License-Identifier: MIT
// Objects that are meshes, in scene files.
#include <gtest/gtest.h>

#include <fstream>

#include "core/mesh/triangle_mesh.h"
#include "core/world/posed_mesh.h"
#include "renderer/io/png.h"
#include "renderer/scene/summary.h"
#include "renderer/scene_json/scene_json.h"
#include "renderer/scene_json/write_scene.h"
#include "tests/support/messages.h"
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
  // Both objects share the mesh.
  EXPECT_GT(summary.bytes, object.mesh->bytes());
  EXPECT_LT(summary.bytes, 2 * object.mesh->bytes() + 3 * sizeof(Object));
}

TEST_F(MeshJson, terrains_are_read_of_heights_and_pictures) {
  const auto rows =
      read(R"("height_field": {"heights": [[0, 1, 0], [0, 2, 0]], "size": [4, 1], "bottom": -1})");
  ASSERT_TRUE(rows) << mistakes_.text();
  EXPECT_TRUE(rows->objects[0].mesh->is_closed());
  EXPECT_EQ(rows->objects[0].mesh->bounds().upper, Vec3<double>(2, 0.5, 2));
  // Black, grey and white, the first row of the picture having the greatest y.
  const std::uint16_t values[] = {0, 65535, 32768, 0};
  const std::vector<unsigned char> png = png_of_grey16(2, 2, values);
  std::ofstream(folder_ / "h.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  const auto picture = read(R"("height_field": {"file": "h.png", "size": [1, 2, 3]})");
  ASSERT_TRUE(picture) << mistakes_.text();
  const TriangleMesh& mesh = *picture->objects[0].mesh;
  EXPECT_EQ(mesh.size(), 2u);
  EXPECT_EQ(mesh.vertices()[3], Vec3<double>(0.5, 1, 3));
  EXPECT_NEAR(mesh.vertices()[0].z(), 1.5, 1e-4);
  EXPECT_EQ(mesh.vertices()[0].y(), -1);
  for (const auto& [object, message] : std::vector<std::pair<std::string, std::string>>{
           {R"("height_field": {"heights": [[0, 1], [0]], "size": [4, 1]})", "heights/1"},
           {R"("height_field": {"heights": [[0, 1]], "size": [4, 1]})", "list of rows"},
           {R"("height_field": {"heights": [[0, 1], [1, 2]], "size": [4]})", "size"},
           {R"("height_field": {"heights": [[0, 1], [1, 2]], "size": [4, 1], "bottom": 0})",
            "below all heights"},
           {R"("height_field": {"file": "gone.png", "size": [4, 1, 1]})", "gone.png"},
           {R"("height_field": {"heights": [[0, 1], [1, 2]], "size": [4, 1]}, "shape": 1)",
            "together"}})
    EXPECT_TRUE(has(wrong(object), message)) << mistakes_.text();
}

TEST_F(MeshJson, planes_of_one_side_are_written_and_read_again) {
  const std::string square = R"("mesh": {"vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
      "triangles": [[0, 1, 2], [0, 2, 3]], "sides": "front"})";
  const auto scene = read(square);
  ASSERT_TRUE(scene) << mistakes_.text();
  Mistakes mistakes("again.json");
  const auto again = parse_scene(scene_text(*scene), folder_ / "", mistakes);
  ASSERT_TRUE(again) << mistakes.text();
  for (const Scene* one : {&*scene, &*again}) {
    const PosedMesh posed(0, one->objects[0].mesh, {});
    PartCounts counts;
    const auto met = [&](double z) {
      const Ray<double> ray{{0.3, 0.2, z}, {0, 0, z > 0 ? -1.0 : 1.0}};
      const bool is_hit = cast_ray(posed, ray, 9, false, 0, counts).cast.status == Status::hit;
      EXPECT_EQ(is_hit, is_met(posed, ray, false, counts));
      return is_hit;
    };
    EXPECT_TRUE(met(1));
    EXPECT_FALSE(met(-1));
  }
  EXPECT_TRUE(has(wrong(R"("mesh": {"vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1]],
      "triangles": [[0, 1, 2], [0, 2, 3]], "sides": "front"})"),
                  "one plane"));
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
            "s.json: /objects/0/shape: not allowed together with \"mesh\"");
  EXPECT_EQ(wrong(R"("mesh": {"file": "two.obj", "scale": 0})"),
            "s.json: /objects/0/mesh/scale: must be > 0 (got 0)");
  EXPECT_TRUE(has(wrong(R"("mesh": {"file": "points.obj"})"), "must have faces"));
  EXPECT_TRUE(has(wrong(R"("mesh": {"file": "none.obj"})"), "none.obj"));
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
            "s.json: /objects/0/mesh/triangles/0/2: must be the number of a vertex, a whole number "
            "from 0 on (got -2)");
}

}  // namespace
}  // namespace minkray
