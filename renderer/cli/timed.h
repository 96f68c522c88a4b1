// SPDX-License-Identifier: MIT
// How long a step of a verb takes.
#pragma once

#include <iostream>

#include "renderer/cli/progress_line.h"

namespace minkray {

/// Calls work() and adds the seconds that it took, which stderr is told if that is wanted.
template <class Work>
void timed(bool verbose, const char* what, double& seconds, const Work& work) {
  const Stopwatch watch;
  work();
  seconds += watch.seconds();
  if (verbose) std::cerr << what << ": " << watch.seconds() << " s\n";
}

}  // namespace minkray
