// SPDX-License-Identifier: MIT
// The worst moment of a motion as a picture: the robot among what is around it, the nearest pair or
// the one that collides in colour, seen from where nothing hides it.
#pragma once

#include <string>
#include <vector>

#include "renderer/cli/verify_inputs.h"
#include "renderer/image/image.h"

namespace minkray {

/// When and where to look: the deepest collision, else the least clearance.
struct WorstMoment {
  std::size_t pair = 0;
  double time = 0;
  Vec3<double> point = Vec3<double>::Zero();  ///< between the two
  bool exists = false;                        ///< false: there are no pairs
};
WorstMoment worst_moment(const MotionVerdict& verdict);

/// Linear, with the verdict's first line written on it.
Image worst_picture(const MotionVerdict& verdict, const Plan& plan, const Workcell& cell,
                    const std::string& title, int samples);

}  // namespace minkray
