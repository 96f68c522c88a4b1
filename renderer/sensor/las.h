// SPDX-License-Identifier: MIT
// Scans as LAS 1.4 files:
// https://www.asprs.org/divisions-committees/lidar-division/laser-las-file-format-exchange-activities
#pragma once

#include "renderer/sensor/scan_files.h"

namespace minkray {

/// Writes the hit points in point format 6: coordinates in steps of a power of ten, the smallest
/// that fits 32 bits; intensity 65535 x intensity x distance^2 (reflectance times cosine); return
/// numbers up to 15; user data the channel, point source the object's number + 1 (0 if either is
/// too large); GPS time in seconds.
std::vector<unsigned char> las_of(const ScanOutput& output);

}  // namespace minkray
