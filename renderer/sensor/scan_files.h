// SPDX-License-Identifier: MIT
// Scans as files. What each holds: .npy one record a ray (and echo) with everything, .csv the same
// as text; .pcd and .ply the points that were met, binary; .exr planes of an image; .png depths in
// millimetres (t of each ray) in 16 bits, 0 where nothing was met or too far. The list of formats
// is scan_formats.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/sensor/scan.h"

namespace minkray {

struct ScanFormat {
  std::string_view ending;
  bool is_image;  ///< the rays must be an image's
  std::vector<unsigned char> (*encode)(const Scan& scan, const SensorRays& rays, int returns);
};
std::span<const ScanFormat> scan_formats();

/// The format of a file's name. Throws WrongUsage with those that there are.
const ScanFormat& scan_format_of(const std::string& file);

/// A JSON list of the objects' numbers and names.
std::string id_table(const Scene& scene);

}  // namespace minkray
