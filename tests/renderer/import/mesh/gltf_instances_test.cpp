// SPDX-License-Identifier: MIT
// Instances, morph targets and vertex colours of glTF, and notes on its extensions.
#include <gtest/gtest.h>

#include <vector>

#include "renderer/image/colour.h"
#include "renderer/scene/summary.h"
#include "renderer/surfaces/mesh_point.h"
#include "renderer/surfaces/texture.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

/// Numbers of a document in a data: URI.
std::string data_uri(const std::vector<float>& numbers) {
  static constexpr char letters[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* bytes = reinterpret_cast<const unsigned char*>(numbers.data());
  std::string text = "data:application/octet-stream;base64,";
  for (std::size_t i = 0; i < 4 * numbers.size(); i += 3) {
    const unsigned long group = (static_cast<unsigned long>(bytes[i]) << 16) |
                                (static_cast<unsigned long>(bytes[i + 1]) << 8) | bytes[i + 2];
    for (int shift = 18; shift >= 0; shift -= 6) text += letters[(group >> shift) & 63];
  }
  return text;
}

/// A tetrahedron, morph moves of 2 along x, two places, two turns about z, two scales: 4 + 4 + 2
/// VEC3 ...
std::string gltf_with(const std::string& node, const std::string& mesh, const std::string& root,
                      const std::string& attributes = "", const std::string& primitive = "") {
  std::vector<float> numbers = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0,
                                0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1, 1, 1, 2, 2, 2, 0};
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0)" +
         node + R"(}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0)" + attributes +
         R"(}, "targets": [{"POSITION": 1}])" + primitive + "}]" + mesh +
         R"(}], "buffers": [{"byteLength": 180, "uri": ")" + data_uri(numbers) +
         R"("}], "bufferViews": [{"buffer": 0, "byteLength": 180}], "accessors": [
         {"bufferView": 0, "byteOffset": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
         {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC3"},
         {"bufferView": 0, "byteOffset": 96, "componentType": 5126, "count": 2, "type": "VEC3"},
         {"bufferView": 0, "byteOffset": 120, "componentType": 5126, "count": 2, "type": "VEC4"},
         {"bufferView": 0, "byteOffset": 152, "componentType": 5126, "count": 2, "type": "VEC3"}])" +
         root + "}";
}

TEST_F(MeshFolder, gltf_shows_instances_and_default_morphs) {
  const auto bounds = [&](const std::string& node, const std::string& mesh) {
    const Imported imported = import("m.gltf", gltf_with(node, mesh, ""));
    Bounds<double> all;
    for (const Object& object : imported.scene.objects) all.extend(bounds_of(object));
    return all;
  };
  EXPECT_NEAR(bounds("", "").upper.x(), 1, 1e-12);
  EXPECT_NEAR(bounds("", R"(, "weights": [0.5])").lower.x(), 1, 1e-12);
  EXPECT_NEAR(bounds("", R"(, "weights": [0.5])").upper.x(), 2, 1e-12);
  const std::string instances = R"(, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {)";
  const Bounds<double> placed = bounds(instances + R"("TRANSLATION": 2, "SCALE": 4}}})", "");
  EXPECT_NEAR(placed.lower.x(), 0, 1e-12);
  EXPECT_NEAR(placed.upper.x(), 11, 1e-12);
  const std::string message = complaint(
      folder.write("w.gltf", gltf_with(instances + R"("TRANSLATION": 0, "SCALE": 4}}})", "", "")));
  EXPECT_TRUE(has(message, "all of one count"));
}

TEST_F(MeshFolder, nodes_have_morph_weights_of_their_own) {
  const Imported imported =
      import("m.gltf", gltf_with(R"(, "children": [1, 2, 3]}, {"mesh": 0, "weights": [1]},
          {"mesh": 0, "weights": [0]}, {"mesh": 0, "weights": [0.5, 7])",
                                 R"(, "weights": [0.5])", ""));
  const std::vector<Object>& objects = imported.scene.objects;
  ASSERT_EQ(objects.size(), 4u);
  for (const auto& [object, lower] : {std::pair(0, 1.0), {1, 2.0}, {2, 0.0}, {3, 1.0}})
    EXPECT_NEAR(bounds_of(objects[std::size_t(object)]).lower.x(), lower, 1e-12) << object;
  EXPECT_EQ(objects[0].mesh, objects[3].mesh);  // there are no more weights than targets
  EXPECT_TRUE(imported.model->passed_over.empty());
}

/// Colour of an object's triangle at a point of it, in the mesh's own frame.
Colour colour_at(const Scene& scene, const Object& object, std::uint32_t triangle,
                 const Vec3<double>& point) {
  const MeshLook& look = *object.look;
  const MeshPoint found = mesh_point(*object.mesh, *look.attributes, triangle, point);
  TexturePoint at;
  at.has_uv = found.has_uv;
  at.uv = found.uv;
  at.uv_slopes = found.uv_slopes;
  const Material& material =
      scene.materials[look.materials.at(look.attributes->material_of.at(triangle))];
  return paint_at(std::get<LambertMaterial>(material.kind).colour, at);
}

// The colours are the places: black, red, green and blue corners.
TEST_F(MeshFolder, colours_of_vertices_change_linearly_over_triangles) {
  const std::string tinted =
      R"(, "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 0.25, 1]}}])";
  for (const bool has_material : {false, true}) {
    const Scene scene =
        import("m.gltf",
               gltf_with("", "", has_material ? tinted : "", R"(, "COLOR_0": 0)",
                         has_material ? R"(, "mode": 5, "material": 0)" : R"(, "mode": 5)"))
            .scene;
    ASSERT_EQ(scene.objects.size(), 1u);
    const Object& object = scene.objects[0];
    ASSERT_EQ(object.mesh->size(), 2u);
    const Colour tint = has_material ? Colour(0.5, 1, 0.25) : Colour::Ones();
    for (std::uint32_t triangle = 0; triangle < 2; ++triangle)
      for (const Vec3<double>& weights :
           {Vec3<double>(1, 0, 0), Vec3<double>(0, 1, 0), Vec3<double>(0, 0, 1),
            Vec3<double>(0.2, 0.5, 0.3), Vec3<double>(0, 0.5, 0.5),
            Vec3<double>(0.9, 0.05, 0.05)}) {
        Vec3<double> point = Vec3<double>::Zero();
        for (int k = 0; k < 3; ++k) point += weights[k] * object.mesh->corner(triangle, k);
        EXPECT_LT((colour_at(scene, object, triangle, point) - point.cwiseProduct(tint)).norm(),
                  1e-6)
            << triangle << " " << weights.transpose();
      }
  }
}

TEST_F(MeshFolder, colours_of_vertices_that_are_all_the_same_are_a_material) {
  // 2, 0, 0 is beyond the range.
  const Scene scene = import("m.gltf", gltf_with("", "", "", R"(, "COLOR_0": 1)")).scene;
  const Object& object = scene.objects.at(0);
  EXPECT_TRUE(object.look->attributes->uv_of.empty());
  EXPECT_LT((colour_at(scene, object, 0, {0, 0, 0}) - Colour(1, 0, 0)).norm(), 1e-12);
}

TEST_F(MeshFolder, hulls_have_the_mean_colour_of_vertices) {
  ImportOptions options;
  options.meshes = MeshChoice::hull;
  const Model model = model_of(gltf_with("", "", "", R"(, "COLOR_0": 0)"), "m.gltf", options);
  ASSERT_EQ(model.geoms.size(), 1u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(from_srgb(model.geoms[0].rgba[i]), 0.25, 1e-12);
}

TEST_F(MeshFolder, colours_of_vertices_must_be_as_many_as_these) {
  const auto complaint_of = [&](const std::string& attributes) {
    return complaint(folder.write("w.gltf", gltf_with("", "", "", attributes)));
  };
  EXPECT_TRUE(has(complaint_of(R"(, "COLOR_0": 2)"),
                  "/meshes/0/primitives/0/attributes/COLOR_0: must have as many items as "
                  "POSITION, 4 (got 2)"));
  EXPECT_TRUE(
      has(complaint_of(R"(, "COLOR_0": 9)"), "must be the number of one of the 5 accessors"));
}

TEST_F(MeshFolder, extensions_that_are_not_read_are_listed) {
  const Imported imported = import(
      "m.gltf",
      gltf_with(
          "", "",
          R"(, "extensionsUsed": ["KHR_materials_sheen", "ACME_wings", "EXT_mesh_gpu_instancing"])"));
  EXPECT_TRUE(tells(*imported.model, "extension ACME_wings"));
  EXPECT_TRUE(tells(*imported.model, "extension KHR_materials_sheen"));
  EXPECT_FALSE(tells(*imported.model, "EXT_mesh_gpu_instancing"));
}

}  // namespace
}  // namespace minkray
