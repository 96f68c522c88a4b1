// SPDX-License-Identifier: MIT
// Prepares a verdict on meshes for a proof, which holds convex bodies only. Meshes in each other's
// hollows are split into parts until planes keep the hulls of the parts apart; meshes that
// collide are replaced by the two triangles that cross.
#pragma once

#include "renderer/verify/referee.h"

namespace minkray {

struct Provable {
  MotionVerdict verdict;
  std::vector<ClearanceBody> bodies;
  std::vector<RefereePair> pairs;
};

/// `verdict` has its planes. Its least clearance may be less afterwards. Throws BadInput if
/// a mesh encloses another without crossing it, or if a split into thousands of parts does not
/// help.
Provable provable(const MotionVerdict& verdict, const JointPath& path,
                  const std::vector<ClearanceBody>& bodies, const std::vector<RefereePair>& pairs,
                  const RefereeOptions& options);

}  // namespace minkray
