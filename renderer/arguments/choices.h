// SPDX-License-Identifier: MIT
// Names of solvers and subalgorithms on the command line.
#pragma once

#include <string>
#include <vector>

#include "core/support/named_kind.h"
#include "renderer/cli/options.h"
#include "renderer/paper/solvers.h"
#include "renderer/paper/subalgorithm.h"

namespace minkray {

/// Adds --solver, whose help has one line per solver.
inline Option add_solver_option(const Verb& verb, std::string& solver) {
  return verb.add_option("--solver", solver, "Ray-cast solver:" + lines_of_help(named_solvers))
      .one_of(names_in(named_solvers))
      .show_default()
      .group(research_group);
}

}  // namespace minkray
