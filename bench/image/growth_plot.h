// SPDX-License-Identifier: MIT
// How the time to an image grows with the number of objects, as a picture: both axes logarithmic.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace minkray::bench {

struct GrowthLine {
  std::string name;
  std::vector<std::pair<double, double>> build, trace, bytes;  ///< by the number of objects
};

/// The whole SVG file: seconds to trace, seconds to build, and bytes beside each other.
std::string growth_svg(const std::string& title, const std::vector<GrowthLine>& lines);

}  // namespace minkray::bench
