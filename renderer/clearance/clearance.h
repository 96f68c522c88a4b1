// SPDX-License-Identifier: MIT
// Clearance of a robot's path: proven bounds of the least signed distance of its links to each
// other and to obstacles, over the whole path and not at samples
// (core/pair_motion/least_distance.h). Between two rows each joint moves at a constant rate.
#pragma once

#include "core/pair_distance/signed_distance.h"
#include "renderer/clearance/bodies.h"
#include "renderer/clearance/step_motion.h"

namespace minkray {

struct ClearanceOptions {
  /// Largest gap between the bounds, relative to the clearance; and never less than 1e-7 of the
  /// robot's size.
  double tolerance = 0.01;
  /// Computes the least distance of each step, not only of the whole path.
  bool every_step = false;
};

/// The least that was seen.
struct Closest {
  double lower = std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double time = 0;
  std::size_t a = 0, b = 0;  ///< indices of the bodies
  SignedDistance distance;
  bool is_settled = true;  ///< true if the bounds are within the tolerance
};

struct Clearance {
  Closest closest;             ///< a, b and the rest are meaningless if there are no pairs
  std::vector<Closest> steps;  ///< if requested
  std::size_t pairs = 0, steps_count = 0, distances = 0;
};

Clearance clearance_of(const JointPath& path, const std::vector<ClearanceBody>& bodies,
                       const std::vector<BodyPair>& pairs, const ClearanceOptions& options);

}  // namespace minkray
