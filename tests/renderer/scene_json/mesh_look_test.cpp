// SPDX-License-Identifier: MIT
// Normals, texture coordinates and materials of meshes in scene files.
#include <gtest/gtest.h>

#include <fstream>

#include "core/files/mesh_attributes.h"
#include "core/mesh/triangle_mesh.h"
#include "renderer/io/png.h"
#include "renderer/scene_json/scene_json.h"
#include "renderer/scene_json/write_scene.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace minkray {
namespace {

constexpr const char* json_square =
    R"("vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "triangles": [[0, 1, 2], [0, 2, 3]])";

class MeshLookJson : public ::testing::Test {
 protected:
  MeshLookJson() {
    const std::vector<std::uint8_t> pixels = {255, 0, 0, 0, 0, 255};
    const auto bytes = png_of(2, 1, pixels);
    std::ofstream(folder_ / "two.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    std::ofstream(folder_ / "two.mtl") << "newmtl red\nKd 1 0 0\nnewmtl wood\nmap_Kd two.png\n";
    std::ofstream(folder_ / "two.obj")
        << "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nvt 1 1\n"
           "usemtl red\nf 1/1/1 2/2/1 3/1/1\nusemtl wood\nf 1/1/1 3/2/1 4/1/1\nusemtl none\n"
           "f 1/1/1 2/2/1 4/1/1\n";
    std::ofstream(folder_ / "bad.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 0\nf 1//1 2//1 3//1\n";
  }
  std::optional<Scene> read(const std::string& object, const std::string& materials = "") {
    mistakes_ = Mistakes("s.json");
    return parse_scene(
        R"({"version": 2, "materials": [{"name": "grey", "type": "lambert", "color": [0.5, 0.5, 0.5]},
                           {"name": "glass", "type": "dielectric"}, {"name": "by_uv",
                           "type": "lambert", "color": {"type": "image", "file": "two.png",
                           "mapping": "uv"}})" +
            materials + R"(], "objects": [{)" + object + "}]}",
        folder_ / "", mistakes_);
  }
  std::string wrong(const std::string& object) {
    EXPECT_FALSE(read(object)) << object;
    return mistakes_.text();
  }
  TemporaryFolder folder_;
  Mistakes mistakes_{"s.json"};
};

Colour colour_named(const Scene& scene, const std::string& material) {
  for (const Material& one : scene.materials)
    if (one.name == material) return std::get<LambertMaterial>(one.kind).colour.colour();
  ADD_FAILURE() << material;
  return Colour::Zero();
}

TEST_F(MeshLookJson, a_file_has_its_own_normals_coordinates_and_materials) {
  const auto scene = read(R"("mesh": {"file": "two.obj"})");
  ASSERT_TRUE(scene) << mistakes_.text();
  const Object& object = scene->objects[0];
  ASSERT_TRUE(object.look);
  EXPECT_EQ(object.look->attributes->normal_of.size(), 3u);
  EXPECT_EQ(object.look->attributes->material_of, (std::vector<std::uint32_t>{0, 1, 2}));
  ASSERT_EQ(object.look->materials.size(), 3u);
  EXPECT_EQ(scene->materials[object.look->materials[0]].name, "red");
  EXPECT_EQ(colour_named(*scene, "red"), Colour(1, 0, 0));
  EXPECT_EQ(colour_named(*scene, "wood"), Colour(0.5, 0, 0.5));
  EXPECT_EQ(object.look->materials[2], MeshAttributes::none);
  EXPECT_EQ(scene->materials[object.material].name, "default");
}

TEST_F(MeshLookJson, an_object_s_material_comes_first_and_names_stand_for_others) {
  auto scene = read(R"("mesh": {"file": "two.obj", "smooth": false}, "material": "grey")");
  ASSERT_TRUE(scene) << mistakes_.text();
  EXPECT_TRUE(scene->objects[0].look->materials.empty());
  EXPECT_TRUE(scene->objects[0].look->attributes->normal_of.empty());
  scene = read(R"("mesh": {"file": "two.obj", "materials": {"red": "grey"}}, "color": [0, 1, 0])");
  ASSERT_TRUE(scene) << mistakes_.text();
  EXPECT_EQ(scene->objects[0].look->materials[0], 0u);
  EXPECT_EQ(scene->objects[0].look->materials[1], MeshAttributes::none);
  EXPECT_TRUE(has(wrong(R"("mesh": {"file": "two.obj", "materials": {"rad": "grey"}})"),
                  "/objects/0/mesh/materials/rad: must be a material of the file; did you mean "
                  "\"red\"?"))
      << mistakes_.text();
}

TEST_F(MeshLookJson, pictures_of_a_file_matter_only_where_they_are_shown) {
  std::ofstream(folder_ / "two.mtl") << "newmtl wood\nmap_Kd nowhere.png\n";
  EXPECT_TRUE(read(R"("mesh": {"file": "two.obj"}, "color": [1, 0, 0])")) << mistakes_.text();
  EXPECT_TRUE(has(wrong(R"("mesh": {"file": "two.obj"})"), "nowhere.png"));
}

TEST_F(MeshLookJson, arrays_are_read_and_written_again) {
  const auto scene = read(std::string(R"("material": "grey", "mesh": {)") + json_square +
                          R"(, "normals": [[0, 0, 2], [0, 1, 0]],
       "normal_triangles": [[0, 1, 0], null], "uv": [[0, 0], [1, 0], [1, 1], [0, 1]],
       "materials": ["by_uv", "grey"], "material_of": [0, null]})");
  ASSERT_TRUE(scene) << mistakes_.text();
  const auto check = [](const Scene& read) {
    const MeshLook& look = *read.objects[0].look;
    EXPECT_EQ(look.attributes->normals[0], Vec3<float>(0, 0, 1));
    EXPECT_EQ(look.attributes->normal_of,
              (std::vector<MeshAttributes::Numbers>{{0, 1, 0}, MeshAttributes::no_numbers}));
    EXPECT_EQ(look.attributes->uv_of, (std::vector<MeshAttributes::Numbers>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(look.attributes->material_of, (std::vector<std::uint32_t>{0, MeshAttributes::none}));
    EXPECT_EQ(read.materials[look.materials[0]].name, "by_uv");
  };
  check(*scene);
  Mistakes mistakes("again.json");
  const auto again = parse_scene(scene_text(*scene), folder_ / "", mistakes);
  ASSERT_TRUE(again) << mistakes.text();
  check(*again);
}

TEST_F(MeshLookJson, smooth_makes_normals_of_the_triangles) {
  for (const char* smooth : {"true", "30"}) {
    const auto scene =
        read(std::string(R"("mesh": {)") + json_square + R"(, "smooth": )" + smooth + "}");
    ASSERT_TRUE(scene) << mistakes_.text();
    EXPECT_EQ(scene->objects[0].look->attributes->normals[0], Vec3<float>(0, 0, 1));
  }
  EXPECT_TRUE(read(R"("mesh": {"file": "bad.obj", "smooth": true})")) << mistakes_.text();
}

TEST_F(MeshLookJson, mistakes_are_told_with_their_place) {
  const auto mesh = [](const std::string& more) {
    return std::string(R"("material": "grey", "mesh": {)") + json_square + ", " + more + "}";
  };
  const std::pair<std::string, std::string> cases[] = {
      {mesh(R"("normals": [[0, 0, 1]])"),
       "/objects/0/mesh/normals: must be one per vertex, 4, without \"normal_triangles\" (got 1)"},
      {mesh(R"("normals": [[0, 0, 1], [0, 0, 0]], "normal_triangles": [null, null])"),
       "/objects/0/mesh/normals/1: must not be zero"},
      {mesh(R"("normals": [[0, 0, 1]], "normal_triangles": [[0, 0, 1], null])"),
       "/objects/0/mesh/normal_triangles/0: must be null or three numbers of \"normals\", less "
       "than 1"},
      {mesh(R"("normals": [[0, 0, 1]], "normal_triangles": [null])"),
       "/objects/0/mesh/normal_triangles: must be a list of 2 items, one per triangle"},
      {mesh(R"("uv": [[0, 0], [1]])"), "/objects/0/mesh/uv/1: must be a list of 2 numbers"},
      {mesh(R"("smooth": 200)"), "/objects/0/mesh/smooth: must be true, false, or"},
      {mesh(R"("materials": ["grey"], "material_of": [0, 1])"),
       "/objects/0/mesh/material_of/1: must be null or the number of one of the 1 materials"},
      {mesh(R"("materials": ["grey"])"), "/objects/0/mesh/material_of: missing"},
      {mesh(R"("materials": ["glass"], "material_of": [0, null])"),
       "/objects/0: must have a single material if any of its materials is transparent (material "
       "\"glass\")"},
      {R"("mesh": {"file": "bad.obj"})", "normals of 1 triangle is unusable"},
      {R"("mesh": {"file": "bad.obj", "uv": []})", "/objects/0/mesh/uv"},
      {R"("shape": {"type": "sphere", "radius": 1}, "material": "by_uv")",
       "must be a mesh with texture coordinates"},
      {R"("mesh": {"file": "bad.obj", "smooth": true}, "material": "by_uv")",
       "must be a mesh with texture coordinates"},
  };
  for (const auto& [object, message] : cases)
    EXPECT_TRUE(has(wrong(object), message)) << object << "\n" << mistakes_.text();
}

}  // namespace
}  // namespace minkray
