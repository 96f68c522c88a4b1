// SPDX-License-Identifier: MIT
// Options for reading a robot's file as a scene.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/files/mesh_parts.h"
#include "core/support/named_kind.h"
#include "renderer/scene/camera_description.h"
#include "renderer/scene_json/scene_json.h"

namespace minkray {

enum class GeometryChoice : unsigned char {
  visual,     ///< shapes that the file's own viewer shows; collision shapes if nothing is shown
  collision,  ///< collision shapes
  all,        ///< every shape there is
};

inline constexpr std::array geometry_choices = {
    NamedKind<GeometryChoice>{GeometryChoice::visual, "visual",
                              "visual shapes, or collision shapes if there are none"},
    NamedKind<GeometryChoice>{GeometryChoice::collision, "collision", "collision shapes"},
    NamedKind<GeometryChoice>{GeometryChoice::all, "all", "both"}};

/// Representation of meshes from files.
enum class MeshChoice : unsigned char {
  of_format,  ///< triangles; in MJCF hulls for contact; all hulls where --split requests parts
  hull,       ///< the convex hulls of their vertices
  exact,      ///< triangles, for contact as well
};

/// Choices by name; the format's own has none.
inline constexpr std::array mesh_choices = {
    NamedKind<MeshChoice>{MeshChoice::hull, "hull", "convex hulls"},
    NamedKind<MeshChoice>{MeshChoice::exact, "exact", "triangles"}};

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
