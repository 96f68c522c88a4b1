// SPDX-License-Identifier: MIT
// Normals, textures and colours of parts of robots' meshes: OBJ, glTF and COLLADA.
#include <gtest/gtest.h>

#include <cstring>

#include "core/files/mesh_attributes.h"
#include "renderer/io/png.h"
#include "renderer/scene_json/scene_json.h"
#include "renderer/scene_json/write_scene.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

std::string png_of_two() {
  const std::vector<std::uint8_t> pixels = {255, 0, 0, 0, 0, 255};
  const auto bytes = png_of(2, 1, pixels);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class LooksOfMeshFiles : public MeshFolder {
 protected:
  Scene urdf(const std::string& mesh, const std::string& more = "") {
    return import("r.urdf", "<robot name='r'><link name='l'><visual><geometry><mesh filename='" +
                                mesh + "'/></geometry>" + more + "</visual></link></robot>")
        .scene;
  }
};

const Material& material_at_triangle(const Scene& scene, std::size_t triangle) {
  const Object& object = scene.objects.at(0);
  const std::uint32_t number = object.look->attributes->material_of.at(triangle);
  return scene.materials[object.look->materials.at(number)];
}

Colour colour_in(const Material& material) {
  return std::get<LambertMaterial>(material.kind).colour.colour();
}

TEST_F(LooksOfMeshFiles, materials_of_an_obj_are_those_of_its_triangles) {
  const Scene scene = urdf("two.obj");
  ASSERT_EQ(scene.objects.size(), 1u);
  ASSERT_TRUE(scene.objects[0].look);
  EXPECT_EQ(colour_in(material_at_triangle(scene, 0)), Colour(1, 0, 0));
  EXPECT_EQ(colour_in(material_at_triangle(scene, 6)), Colour(0, 0, 1));
  // The robot's own colour comes first.
  const Scene green = urdf("two.obj", "<material name='g'><color rgba='0 1 0 1'/></material>");
  EXPECT_TRUE(green.objects[0].look->materials.empty());
  EXPECT_EQ(colour_in(green.materials[green.objects[0].material]), Colour(0, 1, 0));
}

TEST_F(LooksOfMeshFiles, scales_that_mirror_turn_corners_and_map_normals) {
  folder.write("n.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 1\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
               "f 1/1/1 2/2/2 3/3/2\n");
  const Scene scene = import("r.urdf",
                             "<robot name='r'><link name='l'><visual><geometry>"
                             "<mesh filename='n.obj' scale='2 1 -1'/></geometry></visual>"
                             "</link></robot>")
                          .scene;
  const MeshAttributes& made = *scene.objects.at(0).look->attributes;
  EXPECT_LT((made.normals[0].cast<double>() - Vec3<double>(0.5, 0, -1).normalized()).norm(), 1e-6);
  EXPECT_EQ(made.uv_of[0], (MeshAttributes::Numbers{0, 2, 1}));
  EXPECT_EQ(scene.objects[0].mesh->corner(0, 1), Vec3<double>(0, 1, 0));
}

TEST_F(LooksOfMeshFiles, pictures_of_an_obj_that_are_missing_are_noted) {
  folder.write("t.obj",
               "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
  folder.write("t.mtl", "newmtl a\nmap_Kd there.png\n");
  const Imported missing = import("r.urdf",
                                  "<robot name='r'><link name='l'><visual><geometry>"
                                  "<mesh filename='t.obj'/></geometry></visual></link>"
                                  "</robot>");
  EXPECT_TRUE(tells(*missing.model, "<mesh>", "its picture there.png is not shown"));
  folder.write("there.png", png_of_two());
  const Scene scene = urdf("t.obj");
  EXPECT_EQ(colour_in(material_at_triangle(scene, 0)), Colour(0.5, 0, 0.5));
  ASSERT_EQ(scene.pictures.size(), 1u);
  // The scene file names the picture by its whole path.
  Mistakes mistakes("written.json");
  EXPECT_TRUE(parse_scene(scene_text(scene), ".", mistakes)) << mistakes.text();
}

/// One square of two triangles in a buffer: positions, normals, coordinates, indices.
std::string gltf_square(const std::string& attributes, const std::string& image,
                        const std::string& more = "") {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0, "scale": [1, 1, 2]}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, )" +
         attributes +
         R"(}, "indices": 3, "material": 0}]}],
  "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1],
    "baseColorTexture": {"index": 0)" +
         more + R"(}}}],
  "textures": [{"source": 0}], "images": [{)" +
         image + R"(}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 0, "byteOffset": 96, "componentType": 5126, "count": 4, "type": "VEC2"},
    {"bufferView": 0, "byteOffset": 128, "componentType": 5123, "count": 6, "type": "SCALAR"},
    {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 3, "type": "VEC3"}],
  "bufferViews": [{"buffer": 0, "byteLength": 140}, {"buffer": 1, "byteLength": PNG}],
  "buffers": [{"uri": "square.bin", "byteLength": 140}, {"uri": "two.png", "byteLength": PNG}]})";
}

class LooksOfGltf : public LooksOfMeshFiles {
 protected:
  LooksOfGltf() {
    const float numbers[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,  // positions
                             0, 0, 1, 0, 1, 1, 0, 1, 1, 0, 0, 1,  // normals
                             0, 1, 1, 1, 1, 0, 0, 0};             // coordinates
    const std::uint16_t corners[] = {0, 1, 2, 0, 2, 3};
    std::string bytes(reinterpret_cast<const char*>(numbers), sizeof numbers);
    bytes.append(reinterpret_cast<const char*>(corners), sizeof corners);
    folder.write("square.bin", bytes);
    folder.write("two.png", png_of_two());
  }
  std::string filled(std::string text) {
    for (std::size_t at; (at = text.find("PNG")) != text.npos;)
      text.replace(at, 3, std::to_string(png_of_two().size()));
    return text;
  }
};

constexpr const char* normal_and_uv = R"("NORMAL": 1, "TEXCOORD_0": 2)";

TEST_F(LooksOfGltf, textures_of_files_and_within_the_file_are_tinted_by_the_factor) {
  for (const char* image : {R"("uri": "two.png")", R"("bufferView": 1, "mimeType": "image/png")"}) {
    const Scene scene = import("m.gltf", filled(gltf_square(normal_and_uv, image))).scene;
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_LT((colour_in(material_at_triangle(scene, 0)) - Colour(0.25, 0, 0.5)).norm(), 1e-9)
        << image;
    const MeshAttributes& made = *scene.objects[0].look->attributes;
    ASSERT_EQ(made.uv_of.size(), 2u);
    EXPECT_EQ(made.uvs[made.uv_of[0][2]], (std::array<float, 2>{1, 0}));
    const Vec3<double> expected = Vec3<double>(0, 1, 1).normalized();
    EXPECT_LT((made.normals[made.normal_of[0][1]].cast<double>() - expected).norm(), 1e-6);
  }
}

TEST_F(LooksOfGltf, colours_of_vertices_beside_a_texture_are_listed) {
  const Imported imported = import(
      "m.gltf", filled(gltf_square(R"("TEXCOORD_0": 2, "COLOR_0": 1)", R"("uri": "two.png")")));
  EXPECT_TRUE(tells(*imported.model, "colours of vertices", "texture is shown alone"));
  EXPECT_LT((colour_in(material_at_triangle(imported.scene, 0)) - Colour(0.25, 0, 0.5)).norm(),
            1e-9);
}

TEST_F(LooksOfGltf, texture_transforms_move_coordinates) {
  const Scene scene =
      import("m.gltf",
             filled(gltf_square(normal_and_uv, R"("uri": "two.png")",
                                R"(, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0.25],
                         "scale": [2, 1], "rotation": 1.5707963267948966}})")))
          .scene;
  const MeshAttributes& made = *scene.objects.at(0).look->attributes;
  const std::array<float, 2> uv = made.uvs[made.uv_of[0][2]];  // from (1, 0)
  EXPECT_NEAR(uv[0], 0.5, 1e-6);
  EXPECT_NEAR(uv[1], 0.25 - 2, 1e-6);
}

TEST_F(LooksOfGltf, urdf_meshes_have_them_too_mapped_by_the_nodes) {
  folder.write("m.gltf", filled(gltf_square(normal_and_uv, R"("uri": "two.png")")));
  const Scene scene = urdf("m.gltf");
  const MeshAttributes& made = *scene.objects.at(0).look->attributes;
  // The node stretches z, and y up becomes z up.
  const Vec3<double> expected = Vec3<double>(0, -0.5, 1).normalized();
  EXPECT_LT((made.normals[made.normal_of[0][1]].cast<double>() - expected).norm(), 1e-6);
  EXPECT_LT((colour_in(material_at_triangle(scene, 0)) - Colour(0.25, 0, 0.5)).norm(), 1e-9);
}

TEST_F(LooksOfGltf, wrong_accessors_are_errors) {
  const auto wrong = [&](const std::string& attributes) {
    return message_of<BadInput>(
        [&] { import("m.gltf", filled(gltf_square(attributes, R"("uri": "two.png")"))); });
  };
  expect_messages(wrong, {{R"("NORMAL": 4)",
                           "/attributes/NORMAL: must have as many items as POSITION, "
                           "4 (got 3)"},
                          {R"("NORMAL": 9)", "must be the number of one of the 5 accessors"},
                          {R"("TEXCOORD_0": 1)", "must be \"VEC2\""}});
}

std::string dae_square(const std::string& second_p) {
  return R"(<COLLADA version="1.4.1"><library_images><image id="i"><init_from>two.png</init_from>
  </image></library_images><library_effects><effect id="painted"><profile_COMMON>
  <newparam sid="surf"><surface type="2D"><init_from>i</init_from></surface></newparam>
  <newparam sid="samp"><sampler2D><source>surf</source></sampler2D></newparam>
  <technique sid="t"><phong><diffuse><texture texture="samp" texcoord="U"/></diffuse></phong>
  </technique></profile_COMMON></effect><effect id="green"><profile_COMMON><technique sid="t">
  <lambert><diffuse><color>0 1 0 1</color></diffuse></lambert></technique></profile_COMMON></effect>
  </library_effects><library_materials><material id="a"><instance_effect url="#painted"/></material>
  <material id="b"><instance_effect url="#green"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array></source>
  <source id="n"><float_array id="na" count="6">0 0 1 0 1 1</float_array></source>
  <source id="t"><float_array id="ta" count="6">0 0 1 0 1 1</float_array><technique_common>
  <accessor source="#ta" count="3" stride="2"/></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <polylist material="A" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
  <input semantic="NORMAL" source="#n" offset="1"/><input semantic="TEXCOORD" source="#t" offset="2"
  set="0"/><vcount>4</vcount><p>0 0 0 1 1 1 2 1 2 3 0 0</p></polylist>
  <triangles material="B" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
  <input semantic="NORMAL" source="#n" offset="1"/><p>)" +
         second_p + R"(</p></triangles>
  </mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node>
  <scale>1 1 -2</scale><instance_geometry url="#g"><bind_material><technique_common>
  <instance_material symbol="A" target="#a"/><instance_material symbol="B" target="#b"/>
  </technique_common></bind_material></instance_geometry></node></visual_scene>
  </library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

TEST_F(LooksOfGltf, collada_has_textures_and_colours_by_polygons) {
  folder.write("m.dae", dae_square("0 0 1 0 2 0"));
  const Scene scene = urdf("m.dae");
  const MeshAttributes& made = *scene.objects.at(0).look->attributes;
  ASSERT_EQ(made.normal_of.size(), 3u);
  EXPECT_EQ(colour_in(material_at_triangle(scene, 0)), Colour(0.5, 0, 0.5));
  EXPECT_EQ(colour_in(material_at_triangle(scene, 2)), Colour(0, 1, 0));
  // The node mirrors: corners are turned over, and normals point down.
  EXPECT_EQ(made.uvs[made.uv_of[0][1]], (std::array<float, 2>{1, 0}));  // of (1, 1), from the top
  EXPECT_EQ(made.uv_of[2], MeshAttributes::no_numbers);
  EXPECT_EQ(made.normals[made.normal_of[2][0]], Vec3<float>(0, 0, -1));
}

TEST_F(LooksOfGltf, collada_notes_normals_that_are_not_there) {
  folder.write("m.dae", dae_square("0 0 1 7 2 0"));
  const Imported imported = import("r.urdf",
                                   "<robot name='r'><link name='l'><visual><geometry>"
                                   "<mesh filename='m.dae'/></geometry></visual></link>"
                                   "</robot>");
  EXPECT_TRUE(tells(*imported.model, "<mesh>", "normals of 1 triangle is unusable"));
  const MeshAttributes& made = *imported.scene.objects.at(0).look->attributes;
  EXPECT_EQ(made.normal_of[2], MeshAttributes::no_numbers);
  EXPECT_NE(made.normal_of[0], MeshAttributes::no_numbers);
}

}  // namespace
}  // namespace minkray
