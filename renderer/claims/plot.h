// SPDX-License-Identifier: MIT
// Line plots as SVG text.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace minkray {

struct PlotSeries {
  std::string name;
  std::vector<std::pair<double, double>> points;
  bool dots = true;  ///< mark the points, not just the line
};

struct Plot {
  std::string file;  ///< without a folder: "sphere.svg"
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;
};

/// The whole SVG file.
std::string plot_svg(const Plot& plot);

/// Text escaped for SVG.
std::string svg_text(const std::string& text);

}  // namespace minkray
