// SPDX-License-Identifier: MIT
// A frame that stands still, or moves: what a sensor is mounted on.
#pragma once

#include <optional>

#include "renderer/scene/motion.h"

namespace minkray {

struct MovingFrame {
  Affine<double> pose;
  std::optional<Motion> motion = {};  ///< if there is one, `pose` is not looked at

  Affine<double> at(double time) const { return motion ? motion->pose_at(time) : pose; }
};

}  // namespace minkray
