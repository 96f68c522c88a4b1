// SPDX-License-Identifier: MIT
// moveit_msgs/CollisionObject and AttachedCollisionObject: primitives, meshes and planes at poses.
#pragma once

#include <string>
#include <vector>

#include "renderer/import/mesh/mesh_library.h"
#include "renderer/import/model/import_options.h"
#include "renderer/plan/planning_scene.h"

namespace minkray {

class CollisionObjects {
 public:
  /// Mesh files are searched for next to `file`.
  CollisionObjects(const std::string& file, const ImportOptions& options, Mistakes& mistakes);

  /// Adds the object, or applies its `operation` to the object of that name.
  void add(const Json& json, const JsonPath& path, std::vector<PlannedObject>& objects);

  /// Adds the `attached_collision_objects` of a robot state.
  void add_attached(const Json& state, const JsonPath& path, std::vector<PlannedObject>& objects);

 private:
  /// Pose of an item of a list of shapes; without a list of poses that is the object's origin.
  Affine<double> pose_of(const Json& json, std::string_view key, std::size_t index,
                         const JsonPath& path);
  /// Adds a mistake if a list of shapes has poses, but not as many.
  void check_poses(const Json& json, std::string_view shapes, std::string_view poses,
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
