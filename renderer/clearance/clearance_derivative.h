// SPDX-License-Identifier: MIT
// Derivative of a step's least distance with respect to the joint values at its time.
#pragma once

#include <vector>

#include "renderer/clearance/clearance.h"
#include "renderer/clearance/joint_derivative.h"

namespace minkray {

struct ClearanceDerivative {
  std::vector<double> by_joints;  ///< zero if there is no pair, NaN if nothing is known of it
  /// Bounds of their errors, if requested. Infinite on ridges, for meshes, and if there are several
  /// nearest points; else for the pose at this moment, the joints' values rounded.
  std::vector<double> errors;
  /// The bounds do not exclude that there are other derivatives by the joints: at other nearest
  /// points of this pair, or of another one that is as near at this moment. Other moments are not
  /// considered.
  bool is_ridge = false;
};

/// `closest` is an answer of clearance_of() on the same path, bodies and pairs.
ClearanceDerivative derivative_of(const Closest& closest, const JointPath& path,
                                  const std::vector<ClearanceBody>& bodies,
                                  const std::vector<BodyPair>& pairs, const JointWidths& joints,
                                  bool with_errors = false);

}  // namespace minkray
