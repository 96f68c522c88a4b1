// SPDX-License-Identifier: MIT
#include "renderer/sensor/turning_rays.h"

#include "renderer/sensor/ray_directions.h"

namespace minkray {

SensorRays turning_rays(std::span<const LidarChannel> channels, int steps, double seconds,
                        const AzimuthRange* range) {
  SensorRays rays;
  rays.height = static_cast<int>(channels.size());
  rays.width = steps;
  rays.rays.reserve(channels.size() * static_cast<std::size_t>(steps));
  const double turn = range ? std::abs(range->to - range->from) / 360 : 1;
  for (const LidarChannel& channel : channels) {
    for (int step = 0; step < steps; ++step) {
      double share = double(step) / steps;
      double azimuth = std::numbers::pi - 2 * std::numbers::pi * (step + 0.5) / steps;
      if (range) {
        share = steps > 1 ? double(step) / (steps - 1) : 0.5;
        azimuth = radians(range->from + share * (range->to - range->from));
      }
      rays.rays.push_back(
          {{{0, 0, 0},
            direction_of(azimuth + radians(channel.azimuth), radians(channel.elevation))},
           share * turn * seconds});
    }
  }
  return rays;
}

// The rates of turns and of sweeps have an irrational ratio, so that no frame repeats another one.
SensorRays mid_360_rays(std::size_t count, double start) {
  constexpr double rays_per_second = 200000, turns_per_second = 176;
  constexpr double sweeps_per_second = turns_per_second / (16 + std::numbers::phi);
  constexpr double middle = 22.5, swing = 25, line_gap = 3;
  SensorRays rays;
  rays.rays.reserve(count);
  const double first = std::floor(start * rays_per_second + 0.5);
  for (std::size_t i = 0; i < count; ++i) {
    const double number = first + double(i), time = number / rays_per_second;
    const double turn = std::fmod(time * turns_per_second, 1);
    const double sweep = std::fmod(time * sweeps_per_second, 1);
    const double line = number - 4 * std::floor(number / 4) - 1.5;
    const double azimuth = -2 * std::numbers::pi * turn;
    const double triangle = 1 - 4 * std::abs(sweep - std::floor(sweep) - 0.5);
    const double elevation = middle + swing * triangle + line * line_gap * std::cos(azimuth);
    rays.rays.push_back(
        {{{0, 0, 0}, direction_of(azimuth, radians(elevation))}, double(i) / rays_per_second});
  }
  return rays;
}

}  // namespace minkray
