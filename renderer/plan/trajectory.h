// SPDX-License-Identifier: MIT
// Motions as planners write them: trajectory_msgs/JointTrajectory and moveit_msgs/RobotTrajectory
// in YAML or JSON, requests with a start and a goal, CSV, JSON rows, NPY.
#pragma once

#include <string>
#include <vector>

#include "renderer/clearance/step_motion.h"
#include "renderer/import/import_options.h"
#include "renderer/plan/document.h"
#include "renderer/plan/planning_scene.h"

namespace minkray {

struct Trajectory {
  std::vector<JointRow> rows;
  /// Derivatives by time in each row; a row is empty where none are known.
  std::vector<JointValues> rates = {}, accelerations = {};
  JointValues start = {};               ///< of joints that rows do not name
  std::vector<std::string> notes = {};  ///< that the user should know
  bool has_times = true;                ///< false: rows are one second apart
};

/// True if the file's ending is that of a table of numbers: CSV or NPY.
bool is_table(const std::string& file);
/// True of JSON rows: a list of objects whose keys are "time" and joints.
bool is_table(const Json& json, const Model& model);

/// `columns` are the joints of an .npy file, in order; one column more in front is the time.
Trajectory read_table(const std::string& file, Model& model,
                      const std::vector<std::string>& columns, Mistakes& mistakes);

/// The trajectory that a message is or holds.
Trajectory read_trajectory(const Document& document, const Model& model, Mistakes& mistakes);
Trajectory read_trajectory(const Json& message, const JsonPath& path, const Model& model,
                           Mistakes& mistakes);

/// The path of a model that stands where `state` says, but for the rows. Turns of continuous joints
/// by more than half a turn in one step go the shorter way round, and are noted.
JointPath path_of(Trajectory& trajectory, Model& model, const JointValues& state);

}  // namespace minkray
