// SPDX-License-Identifier: MIT
// A verdict as a file that a program of its own confirms (tools/minkray-check): the kinematics, the
// bodies, the path, and a plane for each pair and part of a step. docs/verify.md has the format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/verify/referee.h"

namespace minkray {

struct ProofInputs {
  std::string by;                                 ///< which program
  std::vector<std::filesystem::path> files = {};  ///< whose fingerprints are kept
};

/// `verdict` has kept its planes, and none of its pairs is without (provable.h). Throws BadInput
/// for an undecided one, or if a body's shape is known by its support mapping only.
std::string proof_text(const MotionVerdict& verdict, const JointPath& path,
                       const std::vector<ClearanceBody>& bodies,
                       const std::vector<RefereePair>& pairs, const ProofInputs& inputs);

}  // namespace minkray
