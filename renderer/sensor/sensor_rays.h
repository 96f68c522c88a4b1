// SPDX-License-Identifier: MIT
// Rays of a sensor in its own frame, each with its time within the sweep. Lidars and cameras are
// lists of such rays.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/math/ray.h"
#include "renderer/json/mistakes.h"
#include "renderer/scene/calibrated_camera.h"

namespace minkray {

/// Limit of rays: about 60 GB, with their echoes.
inline constexpr std::size_t most_sensor_rays = std::size_t{1} << 28;

struct SensorRay {
  Ray<double> ray;
  double time = 0;  ///< seconds since the sweep's beginning
};

struct SensorRays {
  std::vector<SensorRay> rays;
  int width = 0, height = 0;  ///< size of an image in rows from the top; 0 if the rays are not an
                              ///< image
  std::size_t missing = 0;    ///< pixels without a ray: their directions are NaN
};

/// Reads rays from a .npy array of (N, 6) numbers, origin and direction, or (N, 7) with t_max; of
/// 32 or 64 bits.
SensorRays rays_of_npy(const std::string& file);

/// "spinning:CHANNELSxSTEPS" with optional ":LOWEST,HIGHEST" elevations (default -15,15) and
/// ":FROM,TO" azimuths in degrees; or a lidar's name (lidar_models) with optional ":STEPS" per
/// turn; or a file (pattern_formats). x is ahead, z the axis. `seconds` is the duration of a turn;
/// patterns that do not repeat begin at `start`, in seconds.
SensorRays rays_of_pattern(const std::string& pattern, double seconds, double start = 0);

/// One ray through the middle of each pixel (CalibratedCamera); for a pinhole with z = 1, so that t
/// is the depth. Rows are exposed one after another. Messages call the camera `name`.
SensorRays rays_of_camera(const CalibratedCamera& camera, const std::string& name);

/// Reads a camera from a JSON file (read_calibrated_camera).
SensorRays rays_of_pinhole(const std::string& file);

}  // namespace minkray
