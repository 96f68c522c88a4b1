// SPDX-License-Identifier: MIT
// Lidars by name: angles and firing times of their channels. The list of them is in
// lidar_models.cpp.
#pragma once

#include <span>
#include <string_view>

namespace minkray {

/// Angles in degrees: up from the horizon, and left of the sensor's forward direction.
struct LidarChannel {
  double elevation, azimuth;
  double delay = 0;  ///< seconds from the beginning of a step to the firing
};

struct LidarModel {
  std::string_view name;
  std::span<const LidarChannel> channels;  ///< from the top; empty: the lidar does not spin
                                           ///< (Mid-360)
  int steps;                               ///< per turn; rays per frame if the lidar does not spin
};
std::span<const LidarModel> lidar_models();

/// Returns the model of that name, ignoring case and hyphens; null if there is none.
const LidarModel* lidar_model(std::string_view name);

}  // namespace minkray
