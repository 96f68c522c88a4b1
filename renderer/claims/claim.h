// SPDX-License-Identifier: MIT
// Claims of the papers, each rerun: the paper's statement and our result.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/claims/plot.h"

namespace minkray {

struct ClaimOptions {
  int rays = 20000;  ///< random rays (or pairs) for each figure
  unsigned seed = 1;
};

struct ClaimResult {
  std::vector<std::string> ours;  ///< our figures, a line each
  std::string verdict;            ///< "confirmed: ...", "not confirmed: ...", "ours alone: ..."
  std::vector<Plot> plots;
};

struct PaperClaim {
  std::string_view id;  ///< value for --only
  std::string_view title;
  std::string_view paper;  ///< the paper's statement
  ClaimResult (*run)(const ClaimOptions& options);
};

ClaimResult sphere_iterations(const ClaimOptions& options);
ClaimResult polytope_iterations(const ClaimOptions& options);
ClaimResult short_rays(const ClaimOptions& options);
ClaimResult cached_axis(const ClaimOptions& options);
ClaimResult caching_in_own_queries(const ClaimOptions& options);
ClaimResult against_separating_axis(const ClaimOptions& options);
ClaimResult float_terminates(const ClaimOptions& options);
ClaimResult first_solution_cost(const ClaimOptions& options);
ClaimResult subalgorithm_comparison(const ClaimOptions& options);
ClaimResult distance_decreases(const ClaimOptions& options);

/// All of them; rows a to f are van den Bergen's (2004), sections 4 and 2.
inline constexpr std::array claims = {
    PaperClaim{
        "a", "sphere: mean iterations against -log eps_tol",
        "roughly proportional to -log(eps_tol); eight on average at 1e-6 for random rays with a "
        "high hit probability",
        sphere_iterations},
    PaperClaim{"b", "polytopes", "usually take fewer iterations", polytope_iterations},
    PaperClaim{
        "c", "finite rays",
        "with an early out the average number of iterations drops dramatically where the rays are "
        "short with respect to the environment",
        short_rays},
    PaperClaim{"d", "caching the separating axis",
               "the number of iterations per frame can be reduced considerably", cached_axis},
    PaperClaim{"e", "the cached ray cast against separating-axis GJK",
               "only slightly more expensive than the incremental separating-axis variant",
               against_separating_axis},
    PaperClaim{
        "f", "single precision",
        "with eps_tol an order of magnitude above the machine epsilon the support point check is "
        "not needed; below the machine epsilon it loops for ever",
        float_terminates},
    PaperClaim{"g", "Algorithm 1 against Algorithm 3",
               "the nested first method has little practical value", first_solution_cost},
    PaperClaim{
        "h", "distance subalgorithms",
        "Johnson's determinants may have wrong signs near affine dependence; signed volumes claim "
        "to be faster and more reliable (Montanari et al. 2017)",
        subalgorithm_comparison},
    PaperClaim{"i", "distance in 2D",
               "the iterates decrease in length, and faceted objects need a finite number of steps",
               distance_decreases},
    PaperClaim{"j", "caching in our own queries",
               "as (d), for our queries of distances and times of impact", caching_in_own_queries},
};

}  // namespace minkray
