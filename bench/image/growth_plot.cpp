// SPDX-License-Identifier: MIT
#include "bench/image/growth_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "renderer/claims/plot.h"

namespace minkray::bench {
namespace {

using Points = std::vector<std::pair<double, double>>;

constexpr double panel_width = 330, panel_height = 330, gap = 70, margin = 65, top = 70,
                 bottom = 130;
constexpr std::array colours = {"#0072b2", "#56b4e9", "#d55e00", "#e69f00", "#009e73", "#cc79a7"};

/// Decades from `low` to `high`, and where they are on the page.
struct Decades {
  int low, high;
  double from, to;

  double operator()(double value) const { return at(std::log10(value)); }
  double at(double decade) const { return from + (decade - low) / (high - low) * (to - from); }
};

Decades decades_for(const std::vector<GrowthLine>& lines, Points GrowthLine::*which, bool of_x,
                    double from, double to) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const GrowthLine& line : lines)
    for (const auto& [x, y] : line.*which) {
      least = std::min(least, std::log10(of_x ? x : y));
      most = std::max(most, std::log10(of_x ? x : y));
    }
  if (!(least <= most)) least = most = 0;
  const int low = static_cast<int>(std::floor(least + 1e-9));
  return {low, std::max(low + 1, static_cast<int>(std::ceil(most - 1e-9))), from, to};
}

std::string power(int exponent) {
  return "10<tspan dy=\"-5\" font-size=\"10\">" + std::to_string(exponent) + "</tspan>";
}

class Page {
 public:
  explicit Page(const std::string& title) {
    const double width = margin + 3 * panel_width + 2 * gap + 20;
    svg_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << ' '
         << top + panel_height + bottom << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
         << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
         << "<text x=\"" << margin << "\" y=\"28\" font-size=\"16\">" << svg_text(title)
         << "</text>\n";
  }

  void panel(int number, const std::string& label, const std::vector<GrowthLine>& lines,
             Points GrowthLine::*which) {
    const double left = margin + number * (panel_width + gap);
    const Decades x = decades_for(lines, which, true, left, left + panel_width);
    const Decades y = decades_for(lines, which, false, top + panel_height, top);
    svg_ << "<text x=\"" << left << "\" y=\"" << top - 14 << "\">" << svg_text(label)
         << "</text>\n";
    for (int d = x.low; d <= x.high; ++d) {
      line(x.at(d), y.from, x.at(d), y.to, "#e4e4e4");
      svg_ << "<text x=\"" << x.at(d) << "\" y=\"" << y.from + 20 << "\" text-anchor=\"middle\">"
           << power(d) << "</text>\n";
    }
    for (int d = y.low; d <= y.high; ++d) {
      line(x.from, y.at(d), x.to, y.at(d), "#e4e4e4");
      svg_ << "<text x=\"" << x.from - 8 << "\" y=\"" << y.at(d) + 5 << "\" text-anchor=\"end\">"
           << power(d) << "</text>\n";
    }
    svg_ << "<text x=\"" << left + panel_width / 2 << "\" y=\"" << y.from + 40
         << "\" text-anchor=\"middle\">objects</text>\n";
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const char* colour = colours[i % colours.size()];
      svg_ << "<polyline fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"2\" points=\"";
      for (const auto& [at_x, at_y] : lines[i].*which) svg_ << x(at_x) << ',' << y(at_y) << ' ';
      svg_ << "\"/>\n";
      for (const auto& [at_x, at_y] : lines[i].*which)
        svg_ << "<circle cx=\"" << x(at_x) << "\" cy=\"" << y(at_y) << "\" r=\"3\" fill=\""
             << colour << "\"/>\n";
    }
  }

  std::string finish(const std::vector<GrowthLine>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double at_x = margin + static_cast<double>(i % 3) * (panel_width + gap);
      const double at_y = top + panel_height + 72 + static_cast<double>(i / 3) * 22;
      line(at_x, at_y - 4, at_x + 26, at_y - 4, colours[i % colours.size()]);
      svg_ << "<text x=\"" << at_x + 34 << "\" y=\"" << at_y << "\">" << svg_text(lines[i].name)
           << "</text>\n";
    }
    svg_ << "</svg>\n";
    return svg_.str();
  }

 private:
  void line(double x1, double y1, double x2, double y2, const char* colour) {
    svg_ << "<line x1=\"" << x1 << "\" y1=\"" << y1 << "\" x2=\"" << x2 << "\" y2=\"" << y2
         << "\" stroke=\"" << colour << "\" stroke-width=\"1.5\"/>\n";
  }
  std::ostringstream svg_;
};

}  // namespace

std::string growth_svg(const std::string& title, const std::vector<GrowthLine>& lines) {
  Page page(title);
  page.panel(0, "seconds to trace", lines, &GrowthLine::trace);
  page.panel(1, "seconds to build", lines, &GrowthLine::build);
  page.panel(2, "bytes", lines, &GrowthLine::bytes);
  return page.finish(lines);
}

}  // namespace minkray::bench
