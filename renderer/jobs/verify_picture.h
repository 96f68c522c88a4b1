// SPDX-License-Identifier: MIT
// Picture of a motion's worst moment: the robot among its obstacles, with the nearest or colliding
// pair in colour, from a viewpoint where nothing hides it.
#pragma once

#include <string>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/jobs/verify_inputs.h"

namespace minkray {

/// Time and place to show: the deepest collision, otherwise the least clearance.
struct WorstMoment {
  std::size_t pair = 0;
  double time = 0;
  Vec3<double> point = Vec3<double>::Zero();  ///< point between the two bodies
  bool exists = false;                        ///< false if there are no pairs
};
WorstMoment worst_moment(const MotionVerdict& verdict);

/// Direction from the worst moment's point, which must exist, to a viewer who sees it: that of the
/// picture.
Vec3<double> worst_view(const MotionVerdict& verdict, const Plan& plan, const Workcell& cell);

/// Linear picture with the verdict's first line written on it.
Image worst_picture(const MotionVerdict& verdict, const Plan& plan, const Workcell& cell,
                    const std::string& title, int samples);

}  // namespace minkray
