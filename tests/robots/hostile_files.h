// SPDX-License-Identifier: MIT
// Files that are made to crash, stall or fill the memory of who reads them, and what the program
// makes of them.
#pragma once

#include <string>
#include <vector>

namespace minkray {

struct HostileRow {
  std::string what;
  int expected = 0, exit_code = 0;  ///< -1: ended by a signal
  double seconds = 0, megabytes = 0;

  bool holds() const { return exit_code == expected && seconds < 10 && megabytes < 1500; }
};

/// Cost of a process.
struct ProcessCost {
  int exit_code = -1;
  double seconds = 0, megabytes = 0;
};
ProcessCost cost_of_minkray(const std::vector<std::string>& arguments);

std::vector<HostileRow> hostile_files();

}  // namespace minkray
