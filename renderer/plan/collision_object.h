// SPDX-License-Identifier: MIT
// moveit_msgs/CollisionObject and AttachedCollisionObject: primitives, meshes and planes at poses.
#pragma once

#include <string>
#include <vector>

#include "renderer/import/import_options.h"
#include "renderer/import/mesh_library.h"
#include "renderer/plan/planning_scene.h"

namespace minkray {

class CollisionObjects {
 public:
  /// Meshes that are named as files are looked for beside `file`.
  CollisionObjects(const std::string& file, const ImportOptions& options, Mistakes& mistakes);

  /// Adds the object, or does what its `operation` says with the one of that name.
  void add(const Json& json, const JsonPath& path, std::vector<PlannedObject>& objects);

  /// Adds a robot state's `attached_collision_objects`.
  void add_attached(const Json& state, const JsonPath& path, std::vector<PlannedObject>& objects);

 private:
  /// The poses of a list of shapes; one that is missing is where the object is.
  Affine<double> pose_of(const Json& json, std::string_view key, std::size_t index,
                         const JsonPath& path);
  void add_primitives(const Json& json, const JsonPath& path, PlannedObject& object);
  void add_meshes(const Json& json, const JsonPath& path, PlannedObject& object);
  void add_mesh(const Json& mesh, const JsonPath& path, const Affine<double>& pose,
                PlannedObject& object);
  void add_planes(const Json& json, const JsonPath& path, PlannedObject& object);

  MeshLibrary meshes_;
  Mistakes& mistakes_;
};

}  // namespace minkray
