// SPDX-License-Identifier: MIT
// A verdict as a file that a separate program confirms (tools/minkray-check): the kinematics, the
// bodies, the path, and a plane for each pair and part of a step. docs/verify.md has the format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/verify/provable.h"

namespace minkray {

struct ProofInputs {
  std::string by;                                 ///< name of the program that wrote the proof
  std::vector<std::filesystem::path> files = {};  ///< files to store the SHA-256 of
};

/// The verdict of `proven` must have stored its planes, and be free or collides. Throws BadInput
/// for an undecided verdict, or if a body's shape is only known by its support mapping.
std::string proof_text(const Provable& proven, const JointPath& path, const ProofInputs& inputs);

}  // namespace minkray
