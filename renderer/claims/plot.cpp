// SPDX-License-Identifier: MIT
#include "renderer/claims/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace minkray {
namespace {

constexpr double width = 720, height = 440, left = 70, right = 20, top = 40, bottom = 55;
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

/// A round number near range / 6: 1, 2 or 5 times a power of ten.
double tick_step(double range) {
  const double rough = range / 6, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10 * power;
}

struct Axis {
  double low, high, from, to;  ///< values, and where on the page
  double operator()(double value) const {
    return from + (value - low) / (high - low) * (to - from);
  }
};

Axis axis_for(double low, double high, double from, double to) {
  if (!(high > low)) high = low + 1;
  const double step = tick_step(high - low);
  return {std::floor(low / step) * step, std::ceil(high / step) * step, from, to};
}

}  // namespace

std::string svg_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '&')
      result += "&amp;";
    else
      result += c;
  }
  return result;
}

std::string plot_svg(const Plot& plot) {
  double x_low = std::numeric_limits<double>::infinity(), x_high = -x_low, y_high = 0;
  for (const PlotSeries& series : plot.series)
    for (const auto& [x, y] : series.points) {
      x_low = std::min(x_low, x);
      x_high = std::max(x_high, x);
      y_high = std::max(y_high, y);
    }
  const Axis x = axis_for(x_low, x_high, left, width - right);
  const Axis y = axis_for(0, y_high, height - bottom, top);
  std::ostringstream svg;
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << ' ' << height
      << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      << "<text x=\"" << left << "\" y=\"24\" font-size=\"15\">" << svg_text(plot.title)
      << "</text>\n";
  const auto line = [&](double x1, double y1, double x2, double y2, const char* colour) {
    svg << "<line x1=\"" << x1 << "\" y1=\"" << y1 << "\" x2=\"" << x2 << "\" y2=\"" << y2
        << "\" stroke=\"" << colour << "\"/>\n";
  };
  const auto label = [&](double at_x, double at_y, const char* anchor, const std::string& text) {
    svg << "<text x=\"" << at_x << "\" y=\"" << at_y << "\" text-anchor=\"" << anchor << "\">"
        << svg_text(text) << "</text>\n";
  };
  const auto number = [](double value) {
    std::ostringstream text;
    text << std::round(value * 1e6) / 1e6;
    return text.str();
  };
  const double x_step = tick_step(x.high - x.low), y_step = tick_step(y.high - y.low);
  for (int i = 0; x.low + i * x_step <= x.high + x_step / 2; ++i) {
    const double value = x.low + i * x_step;
    line(x(value), y.from, x(value), y.to, "#eeeeee");
    label(x(value), y.from + 18, "middle", number(value));
  }
  for (int i = 0; y.low + i * y_step <= y.high + y_step / 2; ++i) {
    const double value = y.low + i * y_step;
    line(x.from, y(value), x.to, y(value), "#eeeeee");
    label(x.from - 8, y(value) + 4, "end", number(value));
  }
  line(x.from, y.from, x.to, y.from, "black");
  line(x.from, y.from, x.from, y.to, "black");
  label((x.from + x.to) / 2, height - 14, "middle", plot.x_label);
  svg << "<text transform=\"translate(18," << (y.from + y.to) / 2
      << ") rotate(-90)\" text-anchor=\"middle\">" << svg_text(plot.y_label) << "</text>\n";
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const PlotSeries& series = plot.series[i];
    const char* colour = colours[i % colours.size()];
    svg << "<polyline fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"1.5\" points=\"";
    for (const auto& [at_x, at_y] : series.points) svg << x(at_x) << ',' << y(at_y) << ' ';
    svg << "\"/>\n";
    if (series.dots)
      for (const auto& [at_x, at_y] : series.points)
        svg << "<circle cx=\"" << x(at_x) << "\" cy=\"" << y(at_y) << "\" r=\"3\" fill=\"" << colour
            << "\"/>\n";
    const double legend = top + 14 + 18 * double(i);
    line(left + 14, legend - 4, left + 38, legend - 4, colour);
    label(left + 44, legend, "start", series.name);
  }
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace minkray
