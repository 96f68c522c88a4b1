// SPDX-License-Identifier: MIT
// moveit_msgs/PlanningScene from YAML or JSON: obstacles, objects that a robot carries, pairs that
// may collide, and the robot's state. Requests and other messages may contain a scene.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"
#include "renderer/plan/document.h"

namespace minkray {

/// moveit_msgs/AllowedCollisionMatrix. A matrix that is not empty replaces the SRDF's pairs, as in
/// MoveIt.
struct CollisionMatrix {
  std::set<std::string> names;
  std::map<std::pair<std::string, std::string>, bool> entries;  ///< the lesser name first
  std::map<std::string, bool> defaults;

  bool empty() const { return names.empty() && defaults.empty(); }
  bool allows(const std::string& a, const std::string& b) const;
};

struct PlannedObject {
  std::string id;
  std::vector<ModelGeom> geoms;  ///< in the frame that the header names
  std::string frame;             ///< a link, the world or a fixed frame
  std::string carrier = {};      ///< the link that carries it; empty: none
  std::set<std::string> touch_links = {};
};

/// Values of joints by name; a floating or planar joint has several numbers.
using JointValues = std::vector<std::pair<std::string, std::vector<double>>>;

struct PlanningScene {
  std::vector<PlannedObject> objects, attached;
  CollisionMatrix matrix;
  JointValues state;
  std::map<std::string, double> padding;               ///< by link
  std::map<std::string, Affine<double>> fixed_frames;  ///< in the planning frame
  std::vector<std::string> notes;                      ///< for the user
};

/// The scene that a message is or contains (in `scene` or `planning_scene`); null if there is none.
const Json* scene_in(const Json& message, JsonPath& path);

/// Uses `model` for the kinds of joints. Mesh files are searched for next to the document.
PlanningScene read_planning_scene(const Document& document, const Json& json, const JsonPath& path,
                                  const Model& model, const ImportOptions& options,
                                  Mistakes& mistakes);

/// Reads a moveit_msgs/RobotState: joint_state and multi_dof_joint_state. Joints that the robot
/// does not have are ignored and noted.
JointValues read_robot_state(const Json& json, const JsonPath& path, const Model& model,
                             std::vector<std::string>& notes, Mistakes& mistakes);

/// Adds the values of a joint that is floating or planar, from its transform. Returns false for
/// other joints.
bool add_values_of_transform(const Json& json, const JsonPath& path, const Model& model,
                             const ModelJoint& joint, JointValues& values, Mistakes& mistakes);

}  // namespace minkray
