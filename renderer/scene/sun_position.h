// SPDX-License-Identifier: MIT
// Direction to the sun at a date, time and location: low-precision formulas of the Astronomical
// Almanac (Michalsky, "The Astronomical Almanac's algorithm for approximate solar position
// (1950-2050)", Solar Energy 40, 1988). Error: 1/50 degree from 1950 to 2050.
#pragma once

#include <optional>
#include <string>

#include "core/math/vec.h"

namespace minkray {

/// Days and their parts since noon of 1 January 2000, universal time; nothing for what is no such
/// text: "2026-06-21T12:30Z", with seconds or without, with "Z" or "+02:00", "-05:30" behind them.
std::optional<double> days_since_2000(const std::string& time);

/// The direction towards the sun's middle, of unit length, as if there were no air: x east, y
/// north, z up. Latitudes are positive in the north, longitudes in the east.
Vec3<double> direction_of_sun(double days_since_2000, double latitude_degrees,
                              double longitude_degrees);

}  // namespace minkray
