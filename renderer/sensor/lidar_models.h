// SPDX-License-Identifier: MIT
// Lidars by name: the angles of their channels. The list of them is in lidar_models.cpp.
#pragma once

#include <span>
#include <string_view>

namespace minkray {

/// Degrees: up from the horizon, and left of where the sensor points.
struct LidarChannel {
  double elevation, azimuth;
};

struct LidarModel {
  std::string_view name;
  std::span<const LidarChannel> channels;  ///< from the top; empty: it does not spin (Mid-360)
  int steps;                               ///< of a turn; rays of a frame if it does not spin
};
std::span<const LidarModel> lidar_models();

/// The model of that name, whatever its case and hyphens; null if there is none.
const LidarModel* lidar_model(std::string_view name);

}  // namespace minkray
