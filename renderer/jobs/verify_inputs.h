// SPDX-License-Identifier: MIT
// Input files of `minkray verify`: a robot, its SRDF, scenes and plans.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/arguments/allowed_links.h"
#include "renderer/cli/command_files.h"
#include "renderer/import/model/import_options.h"
#include "renderer/plan/robot_meaning.h"
#include "renderer/plan/trajectory.h"
#include "renderer/plan/workcell.h"

namespace minkray {

struct VerifyInputs {
  std::string robot;
  std::vector<std::string> scenes;
  AllowedLinks allowed;
  ImportOptions import;
  std::string state, group;  ///< of the SRDF
  std::vector<std::string> inflate;
  WorkcellOptions cell;

  VerifyInputs() { import.geometry = GeometryChoice::collision; }
};

/// A robot and its obstacles, loaded once for any number of plans.
struct VerifyCell {
  Workcell cell;
  JointValues state;                         ///< values of joints that plans do not name
  std::vector<std::string> columns;          ///< joints of .npy files
  std::vector<std::filesystem::path> files;  ///< all files that were read
  std::vector<std::string> notes;            ///< for the user
};

/// Throws BadInput with all mistakes. Adds the files that it reads to `files`.
VerifyCell load_cell(const VerifyInputs& inputs, CommandFiles& files);

struct Plan {
  Trajectory trajectory;
  JointPath path;
};

/// Throws BadInput with all mistakes.
Plan load_plan(const std::string& file, const VerifyCell& cell);
/// Reads a plan of one line, called `name` in mistakes: a message of ROS.
Plan parse_plan(const std::string& line, const std::string& name, const VerifyCell& cell);

}  // namespace minkray
