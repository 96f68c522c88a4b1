// SPDX-License-Identifier: MIT
// The list of ray cast solvers: the values of `--solver`.
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
                      "casts at a few osculating ellipsoids that approximate the shape; the "
                      "result is accurate to rounding"},
    SolverDescription{SolverKind::portal, "portal",
                      "refines a portal, a triangle of support points that the ray crosses"},
    SolverDescription{SolverKind::first_solution, "first-solution",
                      "Algorithm 1 of van den Bergen (2004), a slow reference"},
    SolverDescription{SolverKind::paper_johnson, "paper-johnson",
                      "Algorithm 3 with Johnson's distance subalgorithm"},
    SolverDescription{SolverKind::paper_signed_volumes, "paper-signed-volumes",
                      "Algorithm 3 with the signed-volumes distance subalgorithm"},
};

}  // namespace minkray
