// SPDX-License-Identifier: MIT
// Options for reading a robot's file as a scene.
#pragma once

#include <string>
#include <vector>

#include "core/files/mesh_parts.h"
#include "renderer/scene/camera_description.h"
#include "renderer/scene_json/scene_json.h"

namespace minkray {

enum class GeometryChoice : unsigned char {
  visual,     ///< shapes that the file's own viewer shows; collision shapes if nothing is shown
  collision,  ///< collision shapes
  all,        ///< every shape there is
};

/// Representation of meshes from files.
enum class MeshChoice : unsigned char {
  of_format,  ///< triangles; in MJCF hulls for contact; all hulls where --split requests parts
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
  std::vector<std::string> package_dirs;  ///< search path for package:// and model://
  std::vector<std::string> others;        ///< more files in the same scene
  bool skip_missing_meshes = false;
  bool lenient = false;  ///< leaves out shapes and materials that are wrong
  bool verbose = false;  ///< reports each missing mesh, not only their number
  ScenePurpose purpose = ScenePurpose::picture;  ///< purpose of scene files
  Resolution picture = {960, 720};               ///< that the camera frames everything for

  /// True if meshes stay triangles.
  bool keeps_triangles() const {
    return meshes == MeshChoice::exact ||
           (meshes == MeshChoice::of_format && split == MeshSplit::none);
  }

  /// True if an option is set that scene files do not use.
  bool any() const {
    return geometry != GeometryChoice::visual || split != MeshSplit::none ||
           meshes != MeshChoice::of_format || !keyframe.empty() || !joints.empty() ||
           !joint_rows.empty() || !package_dirs.empty() || skip_missing_meshes || lenient;
  }
};

}  // namespace minkray
