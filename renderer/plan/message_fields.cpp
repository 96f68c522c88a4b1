// SPDX-License-Identifier: MIT
#include "renderer/plan/message_fields.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "renderer/json/closest_word.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

using Names = std::vector<std::string>;

/// Fields of ROS 1 and ROS 2, and keys of Robowflex.
Names fields_of(Message message) {
  switch (message) {
    case Message::header:
      return {"seq", "stamp", "frame_id"};
    case Message::pose:
      return {"position", "orientation", "translation", "rotation"};
    case Message::vector:
      return {"x", "y", "z"};
    case Message::quaternion:
      return {"x", "y", "z", "w"};
    case Message::joint_trajectory:
    case Message::poses_trajectory:
      return {"header", "joint_names", "points"};
    case Message::joint_trajectory_point:
      return {"positions", "velocities", "accelerations", "effort", "time_from_start"};
    case Message::poses_trajectory_point:
      return {"transforms", "velocities", "accelerations", "time_from_start"};
    case Message::with_trajectory:
      return {"joint_trajectory",
              "multi_dof_joint_trajectory",
              "header",
              "joint_names",
              "points",
              "model_id",
              "trajectory",
              "trajectory_start",
              "planned_trajectory",
              "executed_trajectory",
              "multi_dof_trajectory",
              "solution",
              "fraction",
              "start_state",
              "goal",
              "goal_id",
              "goal_constraints",
              "path_constraints",
              "trajectory_constraints",
              "reference_trajectories",
              "workspace_parameters",
              "pipeline_id",
              "planner_id",
              "group_name",
              "num_planning_attempts",
              "allowed_planning_time",
              "planning_time",
              "max_velocity_scaling_factor",
              "max_acceleration_scaling_factor",
              "cartesian_speed_end_effector_link",
              "cartesian_speed_limited_link",
              "max_cartesian_speed",
              "motion_plan_request",
              "motion_plan_response",
              "request",
              "response",
              "result",
              "status",
              "error_code",
              "error_string",
              "path_tolerance",
              "goal_tolerance",
              "goal_time_tolerance",
              "component_path_tolerance",
              "component_goal_tolerance",
              "trajectory_descriptions",
              "processing_time",
              "description",
              "name",
              "id",
              "start_time",
              "end_time"};
    case Message::constraints:
      return {"name", "joint_constraints", "position_constraints", "orientation_constraints",
              "visibility_constraints"};
    case Message::joint_constraint:
      return {"joint_name", "position", "tolerance_above", "tolerance_below", "weight"};
    case Message::robot_state:
      return {"joint_state", "multi_dof_joint_state", "attached_collision_objects", "is_diff"};
    case Message::joint_state:
      return {"header", "name", "position", "velocity", "effort"};
    case Message::poses_state:
      return {"header", "joint_names", "transforms", "twist", "wrench"};
    case Message::attached_object:
      return {"link_name", "object", "touch_links", "detach_posture", "weight"};
    case Message::collision_object:
      return {
          "header",   "id",         "type",   "pose",        "primitives",     "primitive_poses",
          "meshes",   "mesh_poses", "planes", "plane_poses", "subframe_names", "subframe_poses",
          "operation"};
    case Message::primitive:
      return {"type", "dimensions", "polygon"};
    case Message::mesh:
      return {"triangles", "vertices", "resource", "dimensions"};
    case Message::mesh_triangle:
      return {"vertex_indices"};
    case Message::plane:
      return {"coef"};
    case Message::planning_scene:
      return {"name",
              "robot_state",
              "robot_model_name",
              "link_padding",
              "link_scale",
              "fixed_frame_transforms",
              "world",
              "object_colors",
              "allowed_collision_matrix",
              "is_diff",
              "scene",
              "planning_scene",
              "request",
              "motion_plan_request"};
    case Message::world:
      return {"collision_objects", "octomap"};
    case Message::collision_matrix:
      return {"entry_names", "entry_values", "default_entry_names", "default_entry_values"};
    case Message::collision_entry:
      return {"enabled"};
    case Message::link_padding:
      return {"link_name", "padding"};
    case Message::link_scale:
      return {"link_name", "scale"};
    case Message::fixed_frame:
      return {"header", "child_frame_id", "transform"};
  }
  return {};
}

}  // namespace

void check_fields(const Json& json, Message message, const JsonPath& path, Mistakes& mistakes) {
  if (!json.is_object()) {
    const bool may_be_list = message == Message::vector || message == Message::quaternion ||
                             message == Message::collision_entry;
    if (!may_be_list) mistakes.add(path, "must be an object (" + found(json) + ")");
    return;
  }
  std::optional<Names> names;
  for (const Json::Member& member : json.members()) {
    if (!names) names = fields_of(message);
    if (std::ranges::find(*names, member.key) != names->end()) continue;
    if (const auto meant = closest_word(member.key, *names))
      mistakes.add(path / member.key, "unknown key (did you mean \"" + *meant + "\"?)");
  }
}

}  // namespace minkray
