// SPDX-License-Identifier: MIT
// Each file of tests/robots/files is an instance of what public robots' files have: it must load
// and become what other loaders make of it, or be refused with the one message that helps.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "renderer/scene/summary.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

Vec3<double> place_of(const Model& model, const std::string& link) {
  const std::vector<Affine<double>> poses = link_poses(model);
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (model.links[i].name == link) return poses[i].translation;
  ADD_FAILURE() << "no link " << link;
  return Vec3<double>::Zero();
}

template <class S>
const S* only_shape(const Model& model) {
  if (model.geoms.size() != 1 || !model.geoms[0].shape) return nullptr;
  return std::get_if<S>(&model.geoms[0].shape->kind);
}

Bounds<double> bounds_of_all(const Scene& scene) {
  Bounds<double> bounds;
  for (const Object& object : scene.objects) bounds.extend(bounds_of(object));
  return bounds;
}

void expect_at(const Vec3<double>& found, double x, double y, double z) {
  EXPECT_LT((found - Vec3<double>(x, y, z)).norm(), 1e-15) << found.transpose();
}

struct RobotFile {
  const char* file;
  std::function<void(const Model&, const Scene&)> check;
};

const RobotFile files[] = {
    {"sdf-include-of-a-file-that-holds-a-light.world",
     [](const Model& model, const Scene& scene) {
       EXPECT_TRUE(only_shape<Box>(model));
       EXPECT_EQ(scene.objects.size(), 1u);
       EXPECT_TRUE(std::ranges::any_of(
           model.passed_over, [](const PassedOver& one) { return one.what == "<light>"; }));
     }},
    {"sdf-merge-include-joint-and-pose-name-merged-link.sdf",
     [](const Model& model, const Scene&) {
       EXPECT_EQ(model.links.size(), 2u);
       expect_at(place_of(model, "m::stem"), 0, 0, 0);
       expect_at(place_of(model, "m::tool"), 0, 0, 0.7);
     }},
    {"sdf-cone-geometry.sdf",
     [](const Model& model, const Scene&) {
       const auto* cone = only_shape<Cone>(model);
       ASSERT_TRUE(cone);
       EXPECT_EQ(cone->radius, 0.5);
       EXPECT_EQ(cone->half_height, 0.5);
     }},
    {"folder-of-another-name/package-name-differs-from-folder.urdf",
     [](const Model& model, const Scene&) { EXPECT_EQ(model.meshes.size(), 1u); }},
    {"mjcf-global-coordinates-body-without-pos.xml",
     [](const Model& model, const Scene& scene) {
       expect_at(place_of(model, "trunk"), 0, 0, 1.5);
       expect_at(place_of(model, "leg"), 0, 0, 0.6);
       const Bounds<double> bounds = bounds_of_all(scene);
       EXPECT_NEAR(bounds.lower.z(), 0.2 - 0.08, 1e-12);
       EXPECT_NEAR(bounds.upper.z(), 2.1, 1e-12);
     }},
    {"mjcf-attach-model.xml",
     [](const Model& model, const Scene&) {
       EXPECT_EQ(model.geoms.size(), 2u);
       expect_at(place_of(model, "base"), 0, 0, 1);
       expect_at(place_of(model, "p_stem"), 0, 0, 1.5);
     }},
    {"gltf-instances-ignored-in-silence.gltf",
     [](const Model&, const Scene& scene) {
       EXPECT_EQ(scene.objects.size(), 4u);
       const Bounds<double> bounds = bounds_of_all(scene);
       EXPECT_NEAR(bounds.lower.x(), -1, 1e-12);
       EXPECT_NEAR(bounds.upper.x(), 16, 1e-12);
     }},
    {"urdf-collision-only-link-is-shown.urdf",
     [](const Model& model, const Scene& scene) {
       EXPECT_EQ(model.geoms.size(), 2u);
       ASSERT_EQ(scene.objects.size(), 1u);
       EXPECT_EQ(scene.objects[0].name, "hand/sphere");
     }},
    {"urdf-mesh-own-colour-ignored-in-silence.urdf",
     [](const Model& model, const Scene&) {
       ASSERT_EQ(model.geoms.size(), 1u);
       EXPECT_EQ(model.geoms[0].rgba, (Rgba{1, 0, 0, 1}));
     }},
    {"urdf-parent-world-not-declared.urdf",
     [](const Model& model, const Scene&) {
       EXPECT_EQ(model.links.size(), 1u);
       expect_at(place_of(model, "base"), 0, 0, 0.5);
     }},
    {"urdf-drake-ellipsoid.urdf",
     [](const Model& model, const Scene&) {
       const auto* ellipsoid = only_shape<Ellipsoid>(model);
       ASSERT_TRUE(ellipsoid);
       expect_at(ellipsoid->radii, 1, 0.5, 0.25);
     }},
    {"urdf-plane-of-bullet.urdf",
     [](const Model&, const Scene& scene) {
       ASSERT_EQ(scene.objects.size(), 1u);
       EXPECT_TRUE(scene.objects[0].half_space);
     }},
    {"urdf-spherical-joint-of-bullet.urdf",
     [](const Model& model, const Scene&) {
       ASSERT_EQ(model.links.size(), 2u);
       ASSERT_EQ(model.links[1].joints.size(), 1u);
       EXPECT_EQ(model.links[1].joints[0].kind, JointKind::ball);
     }},
};

TEST(RobotFiles, become_what_other_loaders_make_of_them) {
  const std::filesystem::path folder = source_folder() / "tests/robots/files";
  for (const RobotFile& one : files) {
    SCOPED_TRACE(one.file);
    try {
      const Imported imported = import_scene(folder / one.file);
      ASSERT_TRUE(imported.model);
      one.check(*imported.model, imported.scene);
    } catch (const BadInput& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(RobotFiles, of_macros_are_told_so_whatever_they_are_called) {
  const std::string error_text =
      complaint(source_folder() /
                "tests/robots/files/robot-xml-of-unknown-ending-told-as-bad-json.urdf.xacro");
  EXPECT_TRUE(has(error_text, "expand the file first (xacro"));
  EXPECT_FALSE(has(error_text, "JSON"));
}

/// Every file is in the table, or belongs to one that is.
TEST(RobotFiles, are_all_looked_at) {
  for (const auto& entry :
       std::filesystem::directory_iterator(source_folder() / "tests/robots/files")) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() || name == "README.md" || name == "mjcf-part.xml" ||
        name.ends_with(".xacro"))
      continue;
    EXPECT_TRUE(std::ranges::any_of(files, [&](const RobotFile& one) { return one.file == name; }))
        << name;
  }
}

}  // namespace
}  // namespace minkray
