// SPDX-License-Identifier: MIT
// Names of the fields of ROS messages, to find misspelt keys: a misspelt field would read as
// missing, and many fields may be missing.
#pragma once

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

enum class Message : unsigned char {
  header,
  pose,  ///< geometry_msgs/Pose or Transform
  vector,
  quaternion,
  joint_trajectory,
  joint_trajectory_point,
  poses_trajectory,  ///< trajectory_msgs/MultiDOFJointTrajectory
  poses_trajectory_point,
  with_trajectory,  ///< any message that contains a trajectory or a request, and requests
  constraints,
  joint_constraint,
  robot_state,
  joint_state,
  poses_state,  ///< sensor_msgs/MultiDOFJointState
  attached_object,
  collision_object,
  primitive,
  mesh,
  mesh_triangle,
  plane,
  planning_scene,
  world,
  collision_matrix,
  collision_entry,
  link_padding,
  link_scale,
  fixed_frame,
};

/// Adds a mistake if the message is no object (vectors, quaternions and entries of a collision
/// matrix may be lists), and for each key that no version of the message has and that is within a
/// few letters of one that it has. Other unknown keys are ignored: versions of ROS differ, and
/// planners add their own.
void check_fields(const Json& json, Message message, const JsonPath& path, Mistakes& mistakes);

}  // namespace minkray
