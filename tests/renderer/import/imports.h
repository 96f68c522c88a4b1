// SPDX-License-Identifier: MIT
// Common beginning of the importers' tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "renderer/import/import.h"
#include "renderer/import/model/mesh_looks.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace minkray {

inline ImportOptions without_meshes() {
  ImportOptions options;
  options.skip_missing_meshes = true;
  return options;
}

/// Message for a text that must be rejected.
inline std::string mistakes_of(const std::string& text, const std::string& file = "robot.urdf") {
  Mistakes mistakes(file);
  EXPECT_FALSE(parse_model(text, file, {}, mistakes));
  return mistakes.text();
}

/// Message for a file that must be rejected.
inline std::string mistakes_of_file(const std::string& file) {
  Mistakes mistakes(file);
  EXPECT_FALSE(load_model(file, {}, mistakes));
  return mistakes.text();
}

inline Model model_of(const std::string& text, const std::string& file,
                      const ImportOptions& options = {}) {
  Mistakes mistakes(file);
  std::optional<Model> model = parse_model(text, file, options, mistakes);
  EXPECT_TRUE(model) << mistakes.text();
  return model ? std::move(*model) : Model();
}

inline std::string complaint(const std::filesystem::path& file, const ImportOptions& options = {}) {
  return message_of<BadInput>([&] { import_scene(file, options); });
}

inline std::string mjcf(const std::string& world, const std::string& before = "") {
  return "<mujoco>" + before + "<worldbody>" + world + "</worldbody></mujoco>";
}

/// The furthest point of a shape or mesh along n, in its own frame.
inline Vec3<double> support_of(const ModelGeom& geom, const Vec3<double>& n) {
  if (!geom.mesh) return geom.shape->support(n);
  return *std::ranges::max_element(geom.mesh->vertices(), {},
                                   [&](const Vec3<double>& v) { return n.dot(v); });
}

inline std::string_view kind_of(const Model& model) {
  if (model.geoms.size() == 1 && model.geoms[0].mesh) return "mesh";
  if (model.geoms.size() != 1 || !model.geoms[0].shape) return "none";
  return std::visit([](const auto& shape) { return shape.name; }, model.geoms[0].shape->kind);
}

inline bool tells(const Model& model, const std::string& what, const std::string& why = "") {
  return std::ranges::any_of(model.passed_over, [&](const PassedOver& one) {
    return one.what.find(what) != one.what.npos && one.why.find(why) != one.why.npos;
  });
}

/// A folder with a mesh of two parts, red and blue.
class MeshFolder : public ::testing::Test {
 protected:
  MeshFolder() {
    folder.write(
        "two.obj",
        "mtllib two.mtl\nusemtl red\no left\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n"
        "f 1 3 4\nf 2 3 4\nusemtl blue\no right\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 6 7\n"
        "f 5 6 8\nf 5 7 8\n");
    folder.write("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nd 0.5\n");
  }
  Imported import(const std::string& name, const std::string& text,
                  const ImportOptions& options = {}) {
    return import_scene(folder.write(name, text), options);
  }
  TemporaryFolder folder;
};

}  // namespace minkray
