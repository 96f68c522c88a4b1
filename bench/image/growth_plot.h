// SPDX-License-Identifier: MIT
// Plots the growth of the time to an image with the number of objects: both axes logarithmic.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace minkray::bench {

struct GrowthLine {
  std::string name;
  std::vector<std::pair<double, double>> build, trace, bytes;  ///< by the number of objects
};

/// The whole SVG file: seconds to trace, seconds to build, and bytes side by side.
std::string growth_svg(const std::string& title, const std::vector<GrowthLine>& lines);

}  // namespace minkray::bench
