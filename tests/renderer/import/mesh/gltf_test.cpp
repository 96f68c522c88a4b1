// SPDX-License-Identifier: MIT
// glTF: nodes, meshes as hulls, implicit shapes, and files that are made to crash their reader.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <map>

#include "renderer/image/colour.h"
#include "renderer/import/mesh/gltf.h"
#include "renderer/import/mesh/gltf_text.h"
#include "renderer/import/model/mesh_hull.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

/// A box from (0, 0, 0) to (1, 2, 3), and far away a vertex that no triangle uses.
constexpr float box_vertices[9][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 2, 0},   {0, 0, 3},
                                      {1, 0, 3}, {0, 2, 3}, {1, 2, 3}, {50, 50, 50}};
constexpr std::uint16_t box_corners[12] = {0, 1, 2, 3, 2, 1, 4, 5, 6, 7, 6, 5};

std::string buffer_bytes() {
  std::string bytes(reinterpret_cast<const char*>(box_vertices), sizeof box_vertices);
  bytes.append(reinterpret_cast<const char*>(box_corners), sizeof box_corners);
  return bytes;
}

std::string base64_of(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// A document whose mesh 0 is the box; `more` are keys behind it.
std::string gltf_document(
    const std::string& nodes, const std::string& more = "",
    const std::string& uri = R"("uri": "data:application/octet-stream;base64,)" +
                             base64_of(buffer_bytes()) + "\", ") {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": )" +
         nodes + R"(, "meshes": [{"name": "crate", "primitives": [{"attributes": {"POSITION": 0},
         "indices": 1, "material": 0}]}],
         "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0.25, 0, 1]}}],
         "accessors": [{"bufferView": 0, "componentType": 5126, "count": 9, "type": "VEC3"},
           {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
         "bufferViews": [{"buffer": 0, "byteLength": 108},
           {"buffer": 0, "byteOffset": 108, "byteLength": 24}],
         "buffers": [{)" +
         uri + R"("byteLength": 132}])" + more + "}";
}

Model gltf_model(const std::string& text, const ImportOptions& options = {}) {
  return model_of(text, "m.gltf", options);
}

/// Support function of the i-th geom in the world.
double reach_of_geom(const Model& model, std::size_t i, const Vec3<double>& n) {
  const ModelGeom& geom = model.geoms[i];
  const Affine<double> pose = link_poses(model)[static_cast<std::size_t>(geom.link)] * geom.pose;
  return n.dot(pose(support_of(geom, pose.linear.transpose() * n)));
}

const Vec3<double> along_x(1, 0, 0), along_y(0, 1, 0), along_z(0, 0, 1);

TEST(Gltf, y_is_turned_up_and_only_vertices_of_triangles_count) {
  const Model model = gltf_model(gltf_document(R"([{"mesh": 0, "name": "box"}])"));
  ASSERT_EQ(model.geoms.size(), 1u);
  EXPECT_NEAR(reach_of_geom(model, 0, along_x), 1, 1e-15);
  EXPECT_NEAR(reach_of_geom(model, 0, along_z), 2, 1e-15);  // the file's y
  EXPECT_NEAR(reach_of_geom(model, 0, -along_y), 3, 1e-15);
  EXPECT_NEAR(reach_of_geom(model, 0, along_y), 0, 1e-15);
  EXPECT_EQ(model.links[0].name, "box");
  EXPECT_NEAR(model.geoms[0].rgba[1], to_srgb(0.25), 1e-15);
  ASSERT_EQ(model.meshes.size(), 1u);
  EXPECT_EQ(facts_of(model.meshes[0]).hull_points, 8u);
  EXPECT_EQ(model.meshes[0].file, "crate");
}

TEST(Gltf, nodes_stand_in_each_other_by_matrices_or_by_scale_rotation_translation) {
  const Model model = gltf_model(gltf_document(R"([
    {"children": [1, 2], "translation": [10, 0, 0]},
    {"mesh": 0, "scale": [2, 1, 1], "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]},
    {"mesh": 0, "matrix": [0, 3, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]}])"));
  ASSERT_EQ(model.geoms.size(), 2u);
  // x doubled, then turned to y, which is up; y turned to -x.
  EXPECT_NEAR(reach_of_geom(model, 0, along_z), 2, 1e-12);
  EXPECT_NEAR(reach_of_geom(model, 0, along_x), 10, 1e-12);
  EXPECT_NEAR(reach_of_geom(model, 0, -along_x), -8, 1e-12);
  EXPECT_NEAR(reach_of_geom(model, 1, along_z), 3, 1e-12);
  EXPECT_NEAR(reach_of_geom(model, 1, -along_y), 8, 1e-12);
}

TEST(Gltf, binary_files_and_files_beside_say_the_same) {
  const TemporaryFolder folder;
  const Model model = gltf_model(gltf_document(R"([{"mesh": 0}])"));
  std::ofstream(folder / "some data.bin", std::ios::binary) << buffer_bytes();
  std::ofstream(folder / "a.gltf")
      << gltf_document(R"([{"mesh": 0}])", "", R"("uri": "some%20data.bin", )");
  std::string json = gltf_document(R"([{"mesh": 0}])", "", "");
  while (json.size() % 4 != 0) json += ' ';
  const std::string binary = buffer_bytes();
  std::string glb = "glTF";
  const auto word = [&](std::size_t value) {
    for (int i = 0; i < 4; ++i) glb += static_cast<char>(value >> (8 * i) & 255);
  };
  word(2);
  word(12 + 8 + json.size() + 8 + binary.size());
  word(json.size());
  glb += "JSON" + json;
  word(binary.size());
  glb += std::string("BIN\0", 4) + binary;
  std::ofstream(folder / "a.glb", std::ios::binary) << glb;
  for (const char* name : {"a.gltf", "a.glb"}) {
    Mistakes mistakes(name);
    const auto other = load_model(folder / name, {}, mistakes);
    ASSERT_TRUE(other) << mistakes.text();
    for (const Vec3<double>& n : {along_x, along_y, along_z})
      EXPECT_EQ(reach_of_geom(*other, 0, n), reach_of_geom(model, 0, n));
  }
  // As a mesh of a robot, too.
  std::ofstream(folder / "r.urdf") << "<robot name='r'><link name='a'><visual><geometry>"
                                      "<mesh filename='a.glb' scale='1 1 2'/></geometry></visual>"
                                      "</link></robot>";
  const Scene scene = import_scene(folder / "r.urdf").scene;
  ASSERT_TRUE(scene.objects[0].mesh);
  EXPECT_EQ(scene.objects[0].mesh->bounds().upper.z(), 4);
  // Whatever is cut off is refused.
  for (std::size_t size = 0; size < glb.size(); ++size) {
    Mistakes mistakes("a.glb");
    EXPECT_FALSE(parse_model(glb.substr(0, size), "a.glb", {}, mistakes)) << size;
  }
}

TEST(Gltf, parts_have_hulls_of_their_own) {
  // The corners are two triangles' pairs that do not touch: z = 0 and z = 3.
  ImportOptions options;
  options.split = MeshSplit::components;
  const Model parts = gltf_model(gltf_document(R"([{"mesh": 0}])"), options);
  ASSERT_EQ(parts.geoms.size(), 2u);
  EXPECT_EQ(reach_of_geom(parts, 0, -along_y), 0);
  EXPECT_EQ(reach_of_geom(parts, 1, along_y), -3);
  options.split = MeshSplit::groups;
  EXPECT_EQ(gltf_model(gltf_document(R"([{"mesh": 0}])"), options).geoms.size(), 1u);
}

constexpr const char* implicit_shapes = R"(, "extensions": {"KHR_implicit_shapes": {"shapes": [
  {"type": "sphere", "sphere": {"radius": 2}}, {"type": "box", "box": {"size": [1, 2, 3]}},
  {"type": "capsule", "capsule": {"height": 4, "radiusTop": 0.5, "radiusBottom": 1}},
  {"type": "cylinder", "cylinder": {"height": 4, "radiusTop": 1, "radiusBottom": 1}},
  {"type": "cylinder", "cylinder": {"height": 4, "radiusTop": 0, "radiusBottom": 3}},
  {"type": "plane"}]}})";

std::string gltf_collider(const std::string& geometry) {
  return R"({"extensions": {"KHR_physics_rigid_bodies": {"collider": {"geometry": )" + geometry +
         "}}}}";
}

TEST(Gltf, implicit_shapes_are_colliders_along_y) {
  std::string nodes = R"([{"children": [1, 2, 3, 4, 5, 6]})";
  for (int i = 0; i < 6; ++i)
    nodes += ", " + gltf_collider("{\"shape\": " + std::to_string(i) + "}");
  const Model model = gltf_model(gltf_document(nodes + "]", implicit_shapes));
  ASSERT_EQ(model.geoms.size(), 6u);
  const char* const kinds[] = {"sphere", "box", "capsule", "cylinder", "cylinder", "plane"};
  const double up[] = {2, 1, 2.5, 2, 2}, down[] = {2, 1, 3, 2, 2}, aside[] = {2, 0.5, 1, 1, 3};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(model.geoms[i].kind, kinds[i]);
    EXPECT_TRUE(model.geoms[i].collides && !model.geoms[i].is_seen);
    if (!model.geoms[i].shape) continue;
    EXPECT_NEAR(reach_of_geom(model, i, along_z), up[i], 1e-14) << kinds[i];
    EXPECT_NEAR(reach_of_geom(model, i, -along_z), down[i], 1e-14) << kinds[i];
    EXPECT_NEAR(reach_of_geom(model, i, along_x), aside[i], 1e-14) << kinds[i];
  }
  // The plane's normal is up.
  const Affine<double> plane = link_poses(model)[6] * model.geoms[5].pose;
  EXPECT_LT((plane.linear * along_z - along_z).norm(), 1e-15);
}

TEST(Gltf, colliders_may_be_the_hull_of_a_node_and_meshes_are_then_seen_alone) {
  const Model model =
      gltf_model(gltf_document(R"([{"mesh": 0, "children": [1], "scale": [2, 2, 2]}, )" +
                                   gltf_collider(R"({"node": 0, "convexHull": true})") + "]",
                               implicit_shapes));
  ASSERT_EQ(model.geoms.size(), 2u);
  EXPECT_TRUE(model.geoms[0].is_seen && !model.geoms[0].collides);
  EXPECT_TRUE(!model.geoms[1].is_seen && model.geoms[1].collides);
  for (const Vec3<double>& n :
       {along_x, along_y, along_z, Vec3<double>(-along_x), Vec3<double>(-along_y)})
    EXPECT_EQ(reach_of_geom(model, 0, n), reach_of_geom(model, 1, n));
}

TEST(Gltf, nodes_without_an_extent_are_told) {
  const Model model = gltf_model(gltf_document(R"([{"mesh": 0, "scale": [1, 0, 1]}])"));
  EXPECT_TRUE(model.geoms.empty());
  ASSERT_EQ(model.passed_over.size(), 1u);
  EXPECT_TRUE(has(model.passed_over[0].why, "scale of zero"));
}

TEST(Gltf, mistakes_are_told_all_at_once_with_their_place) {
  const std::string message = mistakes_of(
      gltf_document(R"([{"mesh": 7, "children": [1]}, {"rotation": [0, 0, 0, 0], "children": [2]},
                   {"extensions": {"KHR_physics_rigid_bodies":
                      {"collider": {"geometry": {"shape": 9}}}}}])",
                    implicit_shapes),
      "m.gltf");
  expect_parts(message, {"/nodes/0/mesh: must be the number of one of the 1 meshes",
                         "/nodes/1/rotation: must not be zero", "geometry/shape: must be"});
  const auto refused = [](const std::string& text, const std::string& expected) {
    EXPECT_TRUE(has(mistakes_of(text, "m.gltf"), expected));
  };
  refused(R"({"asset": {"version": "1.0"}})", "glTF 1 is not supported");
  refused(gltf_document(R"([{"children": [1]}, {"children": [0]}])"), "without a parent");
  refused(gltf_document(R"([{"children": [1, 1]}, {}])"), "a child twice");
  refused(gltf_document(R"([{"mesh": 0}])",
                        R"(, "extensionsRequired": ["KHR_draco_mesh_compression"])"),
          "KHR_draco_mesh_compression is not supported");
  refused(gltf_document(R"([{"mesh": 0}])", "", R"("uri": "https://x.org/a.bin", )"),
          "in the same folder");
  refused(gltf_document(R"([{"mesh": 0}])", "", R"("uri": "data:,abc", )"), "base64");
  // Any file's bytes are numbers: these were read as points.
  for (const char* elsewhere : {"/etc/passwd", "../../etc/passwd", "a/%2e%2e/../b.bin"})
    refused(
        gltf_document(R"([{"mesh": 0}])", "", R"("uri": ")" + std::string(elsewhere) + R"(", )"),
        "in the same folder");
  std::string text = gltf_document(R"([{"mesh": 0}])");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return changed;
  };
  refused(with("\"count\": 9", "\"count\": 10"), "must lie in its bufferView");
  refused(with("\"count\": 9", "\"count\": 1099511627776"), "not too large");
  refused(with("\"count\": 9", "\"count\": 4"), "less than 4");
  refused(with("\"byteOffset\": 108", "\"byteOffset\": 109"), "must lie in its buffer");
  refused(with("\"byteLength\": 132", "\"byteLength\": 133"), "must have 133 bytes");
  refused(with("5126", "5124"), "componentType");
  refused(with("\"VEC3\"", "\"VEC2\""), "must be \"VEC3\"");
}

TEST(Gltf, sparse_and_normalized_numbers_are_read) {
  // Four corners as normalized bytes, the last of them moved by a sparse value.
  std::string bytes;
  for (const int value : {0, 0, 0, 0, 127, 0, 0, 0, 0, 127, 0, 0, 0, 0, 64, 0})
    bytes += static_cast<char>(value);
  bytes += std::string("\3\0", 2) + std::string("\0\0", 2) + std::string("\0\0\x81\0", 4);
  const std::string text =
      R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5120, "normalized": true, "count": 4,
        "type": "VEC3", "sparse": {"count": 1,
          "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 2}}}],
      "bufferViews": [{"buffer": 0, "byteLength": 16, "byteStride": 4},
        {"buffer": 0, "byteOffset": 16, "byteLength": 2},
        {"buffer": 0, "byteOffset": 20, "byteLength": 3}],
      "buffers": [{"byteLength": 24, "uri": "data:;base64,)" +
      base64_of(bytes) + "\"}]}";
  const Model model = gltf_model(text);
  ASSERT_EQ(model.geoms.size(), 1u);
  EXPECT_EQ(reach_of_geom(model, 0, along_x), 1);
  EXPECT_EQ(reach_of_geom(model, 0, along_z), 1);
  EXPECT_EQ(reach_of_geom(model, 0, along_y), 1);  // -127 / 127 along the file's z
  EXPECT_EQ(reach_of_geom(model, 0, -along_y), 0);
}

TEST(Gltf, a_hundred_thousand_nodes_in_a_chain_are_read) {
  std::string nodes = "[";
  constexpr int count = 100000;
  for (int i = 0; i < count; ++i)
    nodes += R"({"translation": [1, 0, 0], "children": [)" + std::to_string(i + 1) + "]}, ";
  const Model model = gltf_model(gltf_document(nodes + R"({"mesh": 0}])"));
  EXPECT_NEAR(reach_of_geom(model, 0, along_x), count + 1, 1e-6);
}

TEST(Gltf, what_is_shown_again_and_again_is_told) {
  // Nodes of ten bytes each show the same mesh, whose vertices were all taken for one hull.
  const TemporaryFolder folder;
  std::string children, nodes;
  for (int i = 1; i <= 25'001; ++i) {
    children += (i > 1 ? "," : "") + std::to_string(i);
    nodes += R"(,{"mesh":0})";
  }
  std::ofstream(folder / "m.gltf")
      << gltf_document("[{\"children\": [" + children + "]}" + nodes + "]");
  std::string message = message_of<std::runtime_error>(
      [&] { read_gltf_content(folder / "m.gltf", MeshSplit::none, MeshDetail::attributes); });
  EXPECT_TRUE(has(message,
                  "/meshes: must have at most 200000 vertices, of 132 bytes of buffers (got "
                  "200008)"));
  // Each collider names a node with all those behind it below it.
  constexpr int count = 500;
  nodes = "[";
  for (int i = 0; i < count; ++i) {
    std::string node = gltf_collider(R"({"node": )" + std::to_string(i) + "}");
    if (i + 1 < count) node.insert(1, R"("children": [)" + std::to_string(i + 1) + "], ");
    nodes += (i > 0 ? ", " : "") + node;
  }
  message = mistakes_of(gltf_document(nodes + "]"), "m.gltf");
  EXPECT_TRUE(has(message, "number of nodes below colliders must be at most 100500"));
}

TEST(Gltf, colliders_of_one_node_have_one_hull) {
  const std::string collider = gltf_collider(R"({"node": 0, "convexHull": true})");
  const Model model = gltf_model(gltf_document(
      R"([{"mesh": 0, "children": [1, 2]}, )" + collider + ", " + collider + "]", implicit_shapes));
  EXPECT_EQ(model.geoms.size(), 3u);
  EXPECT_EQ(model.meshes.size(), 2u);
}

TEST(Gltf, base64_is_read_with_and_without_its_end) {
  for (const std::string bytes : {"", "a", "ab", "abc", "abcd"}) {
    EXPECT_EQ(from_base64(base64_of(bytes)), bytes);
    std::string text = base64_of(bytes);
    while (text.ends_with('=')) text.pop_back();
    EXPECT_EQ(from_base64(text), bytes);
  }
  EXPECT_FALSE(from_base64("abc!"));
  EXPECT_FALSE(from_base64("abcde"));
}

}  // namespace
}  // namespace minkray
