// SPDX-License-Identifier: MIT
// Instances and morph targets of glTF, and notes on its extensions.
#include <gtest/gtest.h>

#include <vector>

#include "renderer/scene/summary.h"
#include "tests/renderer/import/imports.h"

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
std::string gltf_with(const std::string& node, const std::string& mesh, const std::string& root) {
  std::vector<float> numbers = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0,
                                0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1, 1, 1, 2, 2, 2, 0};
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0)" +
         node +
         R"(}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}]}])" +
         mesh + R"(}], "buffers": [{"byteLength": 180, "uri": ")" + data_uri(numbers) +
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
  const std::string told = complaint(
      folder.write("w.gltf", gltf_with(instances + R"("TRANSLATION": 0, "SCALE": 4}}})", "", "")));
  EXPECT_NE(told.find("all of one count"), std::string::npos) << told;
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
