// SPDX-License-Identifier: MIT
// The option --tolerance of the verbs that answer signed distances.
#pragma once

#include <CLI/CLI.hpp>

#include "renderer/base/errors.h"

namespace minkray {

inline void add_tolerance(CLI::App& verb, double& tolerance) {
  verb.add_option("--tolerance", tolerance,
                  "How near the bounds of signed distances shall be, relative to the sizes")
      ->check(CLI::Range(1e-14, 1.0))
      ->capture_default_str();
}

/// CLI::Range lets nan pass.
inline void check_tolerance(double tolerance) {
  if (!(tolerance <= 1)) throw WrongUsage("--tolerance: must be a number from 1e-14 to 1");
}

}  // namespace minkray
