// SPDX-License-Identifier: MIT
// Scan patterns from files, by their endings. All throw BadInput with the file and the place.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "renderer/sensor/sensor_rays.h"

namespace minkray {

/// .csv: columns time (s), azimuth and zenith or elevation (degrees), one ray per row, as Livox
/// publishes its patterns.
/// .json: "elevations" and, if wanted, "azimuths" of the channels (degrees) and "steps" of a turn;
/// or Ouster's metadata, with "beam_altitude_angles" and "beam_azimuth_angles" (clockwise).
/// .mat3x4f: RobotecGPULidar's patterns, rows of 12 little-endian floats: three rows of a pose,
/// whose z axis is the ray's direction and whose last column its origin.
struct PatternFormat {
  std::string_view ending;
  SensorRays (*read)(const std::string& file, double seconds);
};
std::span<const PatternFormat> pattern_formats();

/// The format of a file's name; null if its ending is none of them.
const PatternFormat* pattern_format_of(const std::string& file);

}  // namespace minkray
