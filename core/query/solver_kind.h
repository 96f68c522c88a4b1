// SPDX-License-Identifier: MIT
// The list of ray cast solvers: what `--solver` takes.
#pragma once

#include <array>
#include <string_view>

namespace minkray {

enum class SolverKind : unsigned char {
  automatic,
  jet,
  portal,
  paper,
  first_solution,
  paper_johnson,
  paper_signed_volumes
};

struct SolverDescription {
  SolverKind kind;
  std::string_view name;
  std::string_view doc;
};

inline constexpr std::array solver_descriptions = {
    SolverDescription{SolverKind::automatic, "auto", "the best solver for each shape"},
    SolverDescription{SolverKind::paper, "paper",
                      "the GJK ray cast, Algorithm 3 of van den Bergen (2004)"},
    SolverDescription{SolverKind::jet, "jet",
                      "casts on the hull of a few osculating ellipsoids, to rounding accuracy"},
    SolverDescription{SolverKind::portal, "portal",
                      "casts on a triangle of support points that the ray passes through"},
    SolverDescription{SolverKind::first_solution, "first-solution",
                      "Algorithm 1 of the same paper, a slow reference"},
    SolverDescription{SolverKind::paper_johnson, "paper-johnson",
                      "Algorithm 3 with Johnson's distance subalgorithm"},
    SolverDescription{SolverKind::paper_signed_volumes, "paper-signed-volumes",
                      "Algorithm 3 with signed volumes"},
};

}  // namespace minkray
