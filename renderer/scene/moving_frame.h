// SPDX-License-Identifier: MIT
// A fixed or moving frame, for example of a sensor's mount.
#pragma once

#include <optional>

#include "renderer/scene/motion.h"

namespace minkray {

struct MovingFrame {
  Affine<double> pose;
  std::optional<Motion> motion = {};  ///< used instead of `pose` if present

  Affine<double> at(double time) const { return motion ? motion->pose_at(time) : pose; }
};

}  // namespace minkray
