// SPDX-License-Identifier: MIT
// POV-Ray, as its users run it: the whole command, sphere for sphere, compared with the whole
// command `minkray render` of the same scene.
#pragma once

#include <optional>
#include <string>

#include "renderer/image/image.h"
#include "renderer/scene/scene.h"

namespace minkray::bench {

struct PovrayOptions {
  std::string minkray = "minkray";  ///< the program
  std::size_t spheres = 100000;
  Resolution resolution{960, 540};
  int samples = 1;
  int threads = 1;
  int rounds = 3;
};

/// Medians of wall clock seconds (several threads) or processor seconds (one) of the commands.
struct PovrayTimes {
  double povray_seconds = 0, minkray_seconds = 0, ratio = 0;
  /// The mean of |pixel - pixel| of the two pictures, of a full scale of 1.
  double picture_difference = 0;
};

/// Nothing if there is no povray on this machine. Throws std::runtime_error if a command fails.
std::optional<PovrayTimes> measure_povray(const PovrayOptions& options);

}  // namespace minkray::bench
