// SPDX-License-Identifier: MIT
// What a sensor asks: rays in its own frame, each with its time within the sweep. Lidars and
// cameras are lists of such rays.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/math/ray.h"
#include "renderer/json/mistakes.h"

namespace minkray {

struct SensorRay {
  Ray<double> ray;
  double time = 0;  ///< in seconds, from the sweep's beginning
};

struct SensorRays {
  std::vector<SensorRay> rays;
  int width = 0, height = 0;  ///< of an image in rows from the top; 0 if the rays are none
};

/// Reads them from a .npy array of (N, 6) numbers, origin and direction, or (N, 7) with t_max; of
/// 32 or 64 bits.
SensorRays rays_of_npy(const std::string& file);

/// "spinning:CHANNELSxSTEPS" with, if wanted, ":LOWEST,HIGHEST" elevations in degrees (else -15,
/// 15): x is ahead, z the axis; all channels of a step are cast at once. Or the name of a CSV file
/// with columns time (s), azimuth and zenith or elevation (degrees), as Livox publishes its
/// patterns. `seconds` is what a turn takes.
SensorRays rays_of_pattern(const std::string& pattern, double seconds);

/// A pinhole camera from a JSON file of fx, fy, cx, cy, width and height, in pixels: x right, y
/// down, z ahead (OpenCV). Directions have z = 1, so that t is the depth.
SensorRays rays_of_pinhole(const std::string& file);

}  // namespace minkray
