// SPDX-License-Identifier: MIT
// Names on the command line that stand for solvers and subalgorithms.
#pragma once

#include <string>
#include <vector>

#include "core/gjk/subalgorithm.h"
#include "core/query/solver_kind.h"

namespace minkray {

inline std::vector<std::string> solver_names() {
  std::vector<std::string> names;
  for (const SolverDescription& solver : solver_descriptions) names.emplace_back(solver.name);
  return names;
}

inline std::vector<std::string> subalgorithm_names() {
  std::vector<std::string> names;
  for (const auto& subalgorithm : subalgorithm_descriptions) names.emplace_back(subalgorithm.name);
  return names;
}

/// What help says of --solver: a line for each.
inline std::string solver_help() {
  std::string help = "How rays are cast:";
  for (const SolverDescription& solver : solver_descriptions)
    help += "\n" + std::string(solver.name) + ": " + std::string(solver.doc);
  return help;
}

/// The name must be one of solver_names.
inline SolverKind solver_named(const std::string& name) {
  for (const SolverDescription& solver : solver_descriptions)
    if (solver.name == name) return solver.kind;
  return SolverKind::automatic;
}

/// The name must be one of subalgorithm_names.
inline SubalgorithmKind subalgorithm_named(const std::string& name) {
  for (const auto& subalgorithm : subalgorithm_descriptions)
    if (subalgorithm.name == name) return subalgorithm.kind;
  return SubalgorithmKind::projection;
}

}  // namespace minkray
