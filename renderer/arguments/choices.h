// SPDX-License-Identifier: MIT
// Names of solvers and subalgorithms on the command line.
#pragma once

#include <string>
#include <vector>

#include "core/gjk/subalgorithm.h"
#include "core/query/solver_kind.h"
#include "core/support/named_kind.h"
#include "renderer/cli/options.h"

namespace minkray {

/// Adds --solver, whose help has one line per solver.
inline Option add_solver_option(const Verb& verb, std::string& solver) {
  return verb
      .add_option("--solver", solver, "Ray-cast solver:" + lines_of_help(solver_descriptions))
      .one_of(names_in(solver_descriptions))
      .show_default()
      .group(research_group);
}

}  // namespace minkray
