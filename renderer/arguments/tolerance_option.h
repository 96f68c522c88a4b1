// SPDX-License-Identifier: MIT
// The option --tolerance of commands that return signed distances.
#pragma once

#include "renderer/base/errors.h"
#include "renderer/cli/options.h"

namespace minkray {

inline void add_tolerance(const Verb& verb, double& tolerance) {
  verb.add_option(
          "--tolerance", tolerance,
          "Maximum gap between lower and upper bound of a distance, relative to the shapes' "
          "sizes")
      .between(1e-14, 1.0)
      .show_default();
}

/// Rejects NaN, which passes a check of the range.
inline void check_tolerance(double tolerance) {
  if (!(tolerance <= 1)) throw WrongUsage("--tolerance: must be a number from 1e-14 to 1");
}

}  // namespace minkray
