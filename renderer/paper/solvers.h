// SPDX-License-Identifier: MIT
// The list of ray cast solvers, which are the values of `--solver`, and the papers' algorithms as
// solvers.
#pragma once

#include <array>

#include "core/cast/solver.h"
#include "core/support/named_kind.h"

namespace minkray {

namespace paper {

CastResult<double> cast_by_algorithm_1(const Shape& shape, const RayNearBall<double>& near,
                                       const Ball<double>& ball,
                                       const GjkCastOptions<double>& options,
                                       const CastObserver& observer);
CastResult<double> cast_by_johnson(const Shape& shape, const RayNearBall<double>& near,
                                   const Ball<double>& ball, const GjkCastOptions<double>& options,
                                   const CastObserver& observer);
CastResult<double> cast_by_signed_volumes(const Shape& shape, const RayNearBall<double>& near,
                                          const Ball<double>& ball,
                                          const GjkCastOptions<double>& options,
                                          const CastObserver& observer);

}  // namespace paper

namespace solver {

inline constexpr std::array<Policy, 4> only_given = {{
    {shape_kind::every, Proof::none, {Stage::given}},
}};
inline constexpr Solver first_solution = {only_given, paper::cast_by_algorithm_1};
inline constexpr Solver paper_johnson = {only_given, paper::cast_by_johnson};
inline constexpr Solver paper_signed_volumes = {only_given, paper::cast_by_signed_volumes};

}  // namespace solver

using NamedSolver = NamedKind<const Solver*>;

inline constexpr std::array named_solvers = {
    NamedSolver{&solver::automatic, "auto", "the best solver for each shape"},
    NamedSolver{&solver::gjk_alone, "paper",
                "the GJK ray cast, Algorithm 3 of van den Bergen (2004)"},
    NamedSolver{&solver::jet, "jet",
                "casts at a few osculating ellipsoids that approximate the shape; the result is "
                "accurate to rounding"},
    NamedSolver{&solver::portal, "portal",
                "refines a portal, a triangle of support points that the ray crosses"},
    NamedSolver{&solver::first_solution, "first-solution",
                "Algorithm 1 of van den Bergen (2004), a slow reference"},
    NamedSolver{&solver::paper_johnson, "paper-johnson",
                "Algorithm 3 with Johnson's distance subalgorithm"},
    NamedSolver{&solver::paper_signed_volumes, "paper-signed-volumes",
                "Algorithm 3 with the signed-volumes distance subalgorithm"},
};

}  // namespace minkray
