// SPDX-License-Identifier: MIT
// Measures the time of a step of a command.
#pragma once

#include <iostream>

#include "renderer/jobs/progress_line.h"

namespace minkray {

/// Calls work() and adds its duration in seconds; prints it to stderr if requested.
template <class Work>
void timed(bool verbose, const char* what, double& seconds, const Work& work) {
  const Stopwatch watch;
  work();
  seconds += watch.seconds();
  if (verbose) std::cerr << what << ": " << watch.seconds() << " s\n";
}

}  // namespace minkray
