// SPDX-License-Identifier: MIT
// Rigid motion between keyed poses.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/world/movement.h"

namespace minkray {

/// Pose at a time, applied after `transform`.
struct PoseKey {
  double time = 0;  ///< in seconds
  Vec3<double> translate = Vec3<double>::Zero();
  std::array<double, 4> rotate = {0, 0, 0, 1};  ///< a quaternion x, y, z, w of unit length
};

/// Keys with increasing times. Between two keys, positions move along a line and rotations turn the
/// shorter way, both at constant speed (Shoemake, "Animating Rotation with Quaternion Curves",
/// 1985). Before the first key and after the last one, the pose is constant.
struct Motion {
  std::vector<PoseKey> keys;
  Affine<double> rest;  ///< from the shape's frame to the one that the keys move

  Affine<double> pose_at(double time) const;
  Vec3<double> translation_at(double time) const;
  /// Movement from the pose at `begin` to the pose at `end`, along a line and by the shorter way.
  /// Exact if no key lies between them.
  Movement<double> movement(double begin, double end) const;
  /// The motion within a frame that is posed so. Nothing if it turns and the map is uneven: it
  /// would be no rigid motion.
  std::optional<Motion> posed(const Affine<double>& frame) const;
};

}  // namespace minkray
