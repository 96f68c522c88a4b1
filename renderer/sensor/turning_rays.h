// SPDX-License-Identifier: MIT
// Rays of spinning lidars: channels above each other, each cast at its own time in a step of a
// turn.
#pragma once

#include <span>

#include "renderer/sensor/lidar_models.h"
#include "renderer/sensor/sensor_rays.h"

namespace minkray {

inline constexpr int most_turn_steps = 1 << 16;

/// Azimuths of the first and of the last step, in degrees left of ahead.
struct AzimuthRange {
  double from, to;
};

/// Rays channel by channel, an image of all around. A whole turn goes clockwise from behind, so
/// that the image's middle is ahead and its right is on the right. A range has a ray at both of its
/// ends and takes its share of the seconds of a turn. The sensor turns on during a channel's delay.
SensorRays turning_rays(std::span<const LidarChannel> channels, int steps, double seconds,
                        const AzimuthRange* range = nullptr);

/// Livox's Mid-360 by a formula that approximates its table: rays every 5 microseconds, four lines
/// in turn, 10,000 turns per minute and ten swings per second, elevations from -7 to 52 degrees.
/// Other moments have other rays.
SensorRays mid_360_rays(std::size_t count, double start);

}  // namespace minkray
