// SPDX-License-Identifier: MIT
// Solvers that tests hold to the last bits.
#pragma once

#include <vector>

#include "renderer/paper/solvers.h"

namespace minkray::testing {

/// Leaves out those that are there to be compared with, slow or inaccurate as their authors
/// describe them: Johnson's and the signed volumes' determinants lose half of the digits, and
/// Algorithm 1 stops where it stalls.
inline std::vector<NamedSolver> accurate_solvers() {
  std::vector<NamedSolver> solvers;
  for (const NamedSolver& solver : named_solvers)
    if (solver.kind == &solver::automatic || solver.kind == &solver::gjk_alone ||
        solver.kind == &solver::jet)
      solvers.push_back(solver);
  return solvers;
}

}  // namespace minkray::testing
