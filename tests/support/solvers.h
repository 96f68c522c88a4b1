// SPDX-License-Identifier: MIT
// Solvers that tests hold to the last bits.
#pragma once

#include <vector>

#include "core/query/solver_kind.h"

namespace minkray::testing {

/// Leaves out those that are there to be compared with, slow or inaccurate as their authors
/// describe them: Johnson's and the signed volumes' determinants lose half of the digits, and
/// Algorithm 1 stops where it stalls.
inline std::vector<SolverDescription> accurate_solvers() {
  std::vector<SolverDescription> solvers;
  for (const SolverDescription& solver : solver_descriptions)
    if (solver.kind == SolverKind::automatic || solver.kind == SolverKind::paper ||
        solver.kind == SolverKind::jet)
      solvers.push_back(solver);
  return solvers;
}

}  // namespace minkray::testing
