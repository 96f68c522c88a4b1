// SPDX-License-Identifier: MIT
// The exit codes of the command line.
#pragma once

namespace minkray {

enum class ExitCode : int {
  done = 0,
  comparison_failed = 1,  ///< also a failed certificate
  wrong_usage = 2,
  bad_input = 3,
  cannot_write = 4,
  undecided = 6,  ///< `verify`: neither proven free nor found to collide (./run uses 5)
};

}  // namespace minkray
