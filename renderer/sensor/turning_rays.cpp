// SPDX-License-Identifier: MIT
#include "renderer/sensor/turning_rays.h"

#include <array>
#include <cmath>

#include "renderer/sensor/ray_directions.h"

namespace minkray {

SensorRays turning_rays(std::span<const LidarChannel> channels, int steps, double seconds,
                        const AzimuthRange* range) {
  SensorRays rays;
  rays.height = static_cast<int>(channels.size());
  rays.width = steps;
  rays.rays.reserve(channels.size() * static_cast<std::size_t>(steps));
  const double turn = range ? std::abs(range->to - range->from) / 360 : 1;
  const double turns_left = range && range->to > range->from ? 1 : -1;
  for (const LidarChannel& channel : channels) {
    const double turns = channel.delay / seconds;
    const double turned = std::isfinite(turns) ? turns_left * 360 * turns : 0;
    for (int step = 0; step < steps; ++step) {
      double share = double(step) / steps;
      double azimuth = std::numbers::pi - 2 * std::numbers::pi * (step + 0.5) / steps;
      if (range) {
        share = steps > 1 ? double(step) / (steps - 1) : 0.5;
        azimuth = radians(range->from + share * (range->to - range->from));
      }
      rays.rays.push_back(
          {{{0, 0, 0},
            direction_of(azimuth + radians(channel.azimuth + turned), radians(channel.elevation))},
           share * turn * seconds + channel.delay});
    }
  }
  return rays;
}

// Fitted to Livox's table at five moments of its first quarter of a second, in degrees: a fan of
// four lines, whose image a mirror turns, swings up and down ten times per second. The rates of
// turns and of swings have an irrational ratio, so that no frame repeats another one.
SensorRays mid_360_rays(std::size_t count, double start) {
  constexpr double rays_per_second = 200000, turns_per_second = 10000.0 / 60;
  constexpr double swings_per_second = turns_per_second / (15 + std::numbers::phi);
  constexpr double first_azimuth = 269, middle = 22.25, swing = 24.9;
  constexpr std::array<double, 4> lines = {4.55, 1.78, -0.98, -3.75};
  const auto angle_of = [](double turns) {
    return 2 * std::numbers::pi * (turns - std::floor(turns));
  };
  SensorRays rays;
  rays.rays.reserve(count);
  const double first = std::floor(start * rays_per_second + 0.5);
  for (std::size_t i = 0; i < count; ++i) {
    const double number = first + double(i), time = number / rays_per_second;
    const double azimuth = radians(first_azimuth) - angle_of(time * turns_per_second);
    const auto line = static_cast<std::size_t>(number - 4 * std::floor(number / 4));
    const double elevation = middle + swing * std::cos(angle_of(time * swings_per_second)) -
                             lines[line] * std::cos(azimuth - radians(first_azimuth - 180));
    rays.rays.push_back(
        {{{0, 0, 0}, direction_of(azimuth, radians(elevation))}, double(i) / rays_per_second});
  }
  return rays;
}

}  // namespace minkray
