// SPDX-License-Identifier: MIT
// What a user may ask for when a robot's file is made a scene of.
#pragma once

#include <string>
#include <vector>

#include "core/files/mesh_parts.h"
#include "renderer/scene/camera_description.h"
#include "renderer/scene/scene_json.h"

namespace minkray {

enum class GeometryChoice : unsigned char {
  visual,     ///< what the file's own viewer shows; collision shapes if nothing is shown
  collision,  ///< what collides
  all,        ///< every shape there is
};

/// What meshes of files are.
enum class MeshChoice : unsigned char {
  of_format,  ///< triangles; in MJCF hulls where they touch; all hulls where --split asks for parts
  hull,       ///< the convex hulls of their vertices
  exact,      ///< triangles, for contact as well
};

struct ImportOptions {
  GeometryChoice geometry = GeometryChoice::visual;
  MeshSplit split = MeshSplit::none;
  MeshChoice meshes = MeshChoice::of_format;
  std::string keyframe;                   ///< empty: none
  std::vector<std::string> joints;        ///< NAME=VALUE each
  std::string joint_rows;                 ///< a CSV or JSON file of values; empty: none
  std::vector<std::string> package_dirs;  ///< where package:// and model:// are looked for
  std::vector<std::string> others;        ///< more files that stand in the same scene
  bool skip_missing_meshes = false;
  bool lenient = false;                          ///< leaves out shapes and materials that are wrong
  bool verbose = false;                          ///< tells each missing mesh, not only how many
  ScenePurpose purpose = ScenePurpose::picture;  ///< what scene files are read for
  Resolution picture = {960, 720};               ///< that the camera frames everything for

  /// Whether meshes stay triangles.
  bool keeps_triangles() const {
    return meshes == MeshChoice::exact ||
           (meshes == MeshChoice::of_format && split == MeshSplit::none);
  }

  /// Whether anything is asked for that a scene file has no use of.
  bool any() const {
    return geometry != GeometryChoice::visual || split != MeshSplit::none ||
           meshes != MeshChoice::of_format || !keyframe.empty() || !joints.empty() ||
           !joint_rows.empty() || !package_dirs.empty() || skip_missing_meshes || lenient;
  }
};

}  // namespace minkray
