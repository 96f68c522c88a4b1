// SPDX-License-Identifier: MIT
// Scan patterns from files, by file extension. All readers throw BadInput with the file and the
// place.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "renderer/sensor/sensor_rays.h"

namespace minkray {

/// .csv: columns time (s), azimuth and zenith or elevation (degrees), one ray per row, as Livox
/// publishes its patterns.
/// .json: "elevations" and optional "azimuths" of the channels (degrees), "firing_times" (seconds
/// from the beginning of a step) and "steps" per turn; or Ouster's metadata, with
/// "beam_altitude_angles" and "beam_azimuth_angles" (clockwise), all fired at once.
/// .mat3x4f: RobotecGPULidar's patterns, rows of 12 little-endian floats: three rows of a pose,
/// whose z axis is the ray's direction and whose last column is the ray's origin.
struct PatternFormat {
  std::string_view ending;
  SensorRays (*read)(const std::string& file, double seconds);
};
std::span<const PatternFormat> pattern_formats();

/// Returns the format of a file name; null for other extensions.
const PatternFormat* pattern_format_of(const std::string& file);

}  // namespace minkray
