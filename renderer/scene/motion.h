// SPDX-License-Identifier: MIT
// Rigid motion between keyed poses.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/world/movement.h"

namespace minkray {

/// Where a thing is at a time, after its `transform`.
struct PoseKey {
  double time = 0;  ///< in seconds
  Vec3<double> translate = Vec3<double>::Zero();
  std::array<double, 4> rotate = {0, 0, 0, 1};  ///< a quaternion x, y, z, w of unit length
};

/// Keys with times that rise. Between two keys positions go along a line at constant speed and
/// rotations turn by the shorter way at constant speed (Shoemake, "Animating Rotation with
/// Quaternion Curves", 1985); before the first key and after the last one all stand still.
struct Motion {
  std::vector<PoseKey> keys;
  Affine<double> rest;  ///< from the shape's frame to the one that the keys move

  Affine<double> pose_at(double time) const;
  Vec3<double> translation_at(double time) const;
  /// From where it stands at the first time straight to where it stands at the second, and by the
  /// shorter way: just what the keys say if none lies between.
  Movement<double> movement(double begin, double end) const;
  /// The motion within a frame that is posed so. Nothing if it turns and the map is uneven: it
  /// would be no rigid motion.
  std::optional<Motion> posed(const Affine<double>& frame) const;
};

}  // namespace minkray
