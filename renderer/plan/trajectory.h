// SPDX-License-Identifier: MIT
// Motions in the formats of planners: trajectory_msgs/JointTrajectory and
// moveit_msgs/RobotTrajectory in YAML or JSON, requests with a start and a goal, CSV, JSON rows,
// NPY.
#pragma once

#include <string>
#include <vector>

#include "renderer/clearance/step_motion.h"
#include "renderer/import/model/import_options.h"
#include "renderer/plan/document.h"
#include "renderer/plan/planning_scene.h"

namespace minkray {

struct Trajectory {
  std::vector<JointRow> rows;
  /// Derivatives by time at each row; a row is empty if none are given.
  std::vector<JointValues> rates = {}, accelerations = {};
  JointValues start = {};               ///< values of joints that rows do not name
  std::vector<std::string> notes = {};  ///< for the user
  bool has_times = true;                ///< false: rows are one second apart
};

/// True if the file extension is that of a table of numbers: CSV or NPY.
bool is_table(const std::string& file);
/// True for JSON rows: a list of objects whose keys are "time" and joints.
bool is_table(const Json& json, const Model& model);

/// `columns` are the joints of an .npy file, in order; an additional first column is the time.
Trajectory read_table(const std::string& file, Model& model,
                      const std::vector<std::string>& columns, Mistakes& mistakes);

/// Returns the trajectory that a message is or contains.
Trajectory read_trajectory(const Document& document, const Model& model, Mistakes& mistakes);
Trajectory read_trajectory(const Json& message, const JsonPath& path, const Model& model,
                           Mistakes& mistakes);

/// Path of a model whose joints have the values of `state`, except those that rows give. Continuous
/// joints that turn by more than half a turn in one step take the shorter way, with a note.
JointPath path_of(Trajectory& trajectory, Model& model, const JointValues& state);

}  // namespace minkray
