// SPDX-License-Identifier: MIT
// The way that a sensor goes, from a CSV file of its poses.
#pragma once

#include <string>

#include "renderer/scene/moving_frame.h"

namespace minkray {

/// Columns time (s), x, y, z, and qx, qy, qz, qw if it turns; times must rise. Throws BadInput with
/// all mistakes.
MovingFrame read_sensor_path(const std::string& file);

}  // namespace minkray
