// SPDX-License-Identifier: MIT
// Prepares a verdict on meshes for a proof, which holds convex bodies only. Meshes in each other's
// hollows are split into parts until planes keep the hulls of the parts apart; meshes that
// collide are replaced by two triangles that cross, at another moment of the stretch if need be.
#pragma once

#include "renderer/verify/referee.h"

namespace minkray {

struct Provable {
  MotionVerdict verdict;
  std::vector<ClearanceBody> bodies;
  std::vector<RefereePair> pairs;
  /// Pairs, ascending, whose first body is a closed mesh that encloses the second without crossing
  /// it.
  std::vector<std::size_t> enclosures = {};
};

/// `verdict` has its planes. Its least clearance may be less afterwards. Throws BadInput if a split
/// into thousands of parts does not help.
Provable provable(const MotionVerdict& verdict, const JointPath& path,
                  const std::vector<ClearanceBody>& bodies, const std::vector<RefereePair>& pairs,
                  const RefereeOptions& options);

}  // namespace minkray
