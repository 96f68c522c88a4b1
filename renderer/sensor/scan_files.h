// SPDX-License-Identifier: MIT
// Scans as files: .npy records with everything, .csv the same as text; .pcd, .ply, .las and .mcap
// the hit points; .exr planes of an image; .png depths in millimetres (t of each ray) in 16 bits, 0
// for no hit or too far; .json an image's masks (COCO). scan_formats lists the formats.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/sensor/scan.h"

namespace minkray {

/// Contents of the file, by reference.
struct ScanOutput {
  const Scan& scan;
  const SensorRays& rays;
  int returns;
  const Scene& scene;
  double start = 0;        ///< start of the sweep in seconds
  bool has_halfs = false;  ///< floats of .exr have 16 bits

  /// Row of an image's ray; 0 if the rays are not an image.
  int channel_of(std::size_t ray) const {
    return rays.width > 0 ? static_cast<int>(ray / static_cast<std::size_t>(rays.width)) : 0;
  }
  /// Seconds at which the echo's ray was cast.
  double time_of(std::size_t echo) const {
    return start + rays.rays[echo / static_cast<std::size_t>(returns)].time;
  }
};

struct ScanFormat {
  std::string_view ending;
  bool is_image;  ///< true if the format needs an image's rays
  std::vector<unsigned char> (*encode)(const ScanOutput& output);
};
std::span<const ScanFormat> scan_formats();

/// Returns the format of a file name. Throws WrongUsage that lists the formats.
const ScanFormat& scan_format_of(const std::string& file);

/// A JSON list of the objects' numbers and names.
std::string id_table(const Scene& scene);

}  // namespace minkray
