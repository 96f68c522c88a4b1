// SPDX-License-Identifier: MIT
// What an SRDF (http://wiki.ros.org/srdf) says besides the pairs that may touch: groups of joints,
// their named states, and virtual joints, which place a robot in the world. For the pairs see
// renderer/clearance/allowed_pairs.h.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/import/model.h"
#include "renderer/import/scene_of_model.h"

namespace minkray {

struct GroupState {
  std::string group, name;
  std::vector<std::pair<std::string, std::vector<double>>> values;  ///< of joints
};

struct RobotMeaning {
  std::map<std::string, std::vector<std::string>> groups;  ///< joints that move, as links follow
  std::vector<GroupState> states;
  std::vector<std::string> notes;  ///< what names joints or links that the robot does not have
};

/// Reads groups and states. A virtual joint that floats or slides in a plane becomes a joint of its
/// link, which must be a root. Adds mistakes of the file.
RobotMeaning read_robot_meaning(const std::string& file, Model& model, Mistakes& mistakes);

/// The state of that name; "GROUP/NAME" where several groups have one. Adds a mistake if there is
/// none.
const GroupState* find_state(const RobotMeaning& meaning, const std::string& name,
                             Mistakes& mistakes);

/// All joints that move and mimic no other one, in the model's order.
std::vector<std::string> moving_joints(const Model& model);

}  // namespace minkray
