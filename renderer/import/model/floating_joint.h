// SPDX-License-Identifier: MIT
// Floating joints in a frame that is not the world's. A free joint (JointKind::free) places its
// link in the world, so URDF's become three slides along the frame's axes, then a ball of the
// joint's name.
#pragma once

#include <array>
#include <string>

namespace minkray {

/// Names of the slides along x, y and z.
inline std::array<std::string, 3> slides_of_floating(const std::string& joint) {
  return {joint + "/x", joint + "/y", joint + "/z"};
}

}  // namespace minkray
