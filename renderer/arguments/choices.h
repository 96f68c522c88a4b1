// SPDX-License-Identifier: MIT
// Names of solvers and subalgorithms on the command line.
#pragma once

#include <string>
#include <vector>

#include "core/gjk/subalgorithm.h"
#include "core/query/solver_kind.h"
#include "renderer/cli/options.h"

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

/// Adds --solver, whose help has one line per solver.
inline Option add_solver_option(const Verb& verb, std::string& solver) {
  std::string help = "Ray-cast solver:";
  for (const SolverDescription& description : solver_descriptions)
    help += "\n" + std::string(description.name) + ": " + std::string(description.doc);
  return verb.add_option("--solver", solver, help)
      .one_of(solver_names())
      .show_default()
      .group(research_group);
}

/// Converts a name, which must be one of solver_names.
inline SolverKind solver_named(const std::string& name) {
  for (const SolverDescription& solver : solver_descriptions)
    if (solver.name == name) return solver.kind;
  return SolverKind::automatic;
}

/// Converts a name, which must be one of subalgorithm_names.
inline SubalgorithmKind subalgorithm_named(const std::string& name) {
  for (const auto& subalgorithm : subalgorithm_descriptions)
    if (subalgorithm.name == name) return subalgorithm.kind;
  return SubalgorithmKind::projection;
}

}  // namespace minkray
