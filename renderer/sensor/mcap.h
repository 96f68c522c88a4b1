// SPDX-License-Identifier: MIT
// Scans as ROS 2 messages in MCAP files: https://mcap.dev/spec and sensor_msgs/msg/PointCloud2.
#pragma once

#include "renderer/sensor/scan_files.h"

namespace minkray {

/// Limit of echoes: a message's bytes are counted in 32 bits.
inline constexpr std::size_t most_mcap_points = 0xffffffffu / 28;

/// Writes one message on the topic /points at the sweep's start: the hit points in the frame "map",
/// with x, y, z, intensity, ring (the channel), time (seconds from the start) and object. The file
/// has an index.
std::vector<unsigned char> mcap_of(const ScanOutput& output);

}  // namespace minkray
