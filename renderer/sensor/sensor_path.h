// SPDX-License-Identifier: MIT
// The path of a sensor, from a CSV file of its poses.
#pragma once

#include <string>

#include "renderer/scene/moving_frame.h"

namespace minkray {

/// Reads columns time (s), x, y, z, and optionally qx, qy, qz, qw. Times must increase. Throws
/// BadInput with all mistakes.
MovingFrame read_sensor_path(const std::string& file);

}  // namespace minkray
