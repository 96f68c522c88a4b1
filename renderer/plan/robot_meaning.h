// SPDX-License-Identifier: MIT
// Contents of an SRDF (http://wiki.ros.org/srdf) other than the pairs that may touch: groups of
// joints, their named states, and virtual joints, which place a robot in the world. For the pairs
// see renderer/clearance/allowed_pairs.h.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/import/model/model.h"
#include "renderer/import/scene_of_model.h"

namespace minkray {

struct GroupState {
  std::string group, name;
  std::vector<std::pair<std::string, std::vector<double>>> values;  ///< values of each joint
};

struct RobotMeaning {
  std::map<std::string, std::vector<std::string>> groups;  ///< joints that move, in the order of
                                                           ///< links
  std::vector<GroupState> states;
  std::vector<std::string> notes;  ///< names of joints or links that the robot does not have
};

/// Reads groups and states. A floating or planar virtual joint becomes a joint of its link, which
/// must be a root. Adds the file's mistakes.
RobotMeaning read_robot_meaning(const std::string& file, Model& model, Mistakes& mistakes);

/// Returns the state of that name, or "GROUP/NAME" if several groups have one. Adds a mistake if
/// there is none.
const GroupState* find_state(const RobotMeaning& meaning, const std::string& name,
                             Mistakes& mistakes);

/// Names of all joints that move and do not mimic another one, in the model's order.
std::vector<std::string> moving_joints(const Model& model);

}  // namespace minkray
