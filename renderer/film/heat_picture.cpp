// SPDX-License-Identifier: MIT
// Draws a heatmap: panels with titles, and a scale below.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "renderer/film/heatmap.h"
#include "renderer/image/colour.h"
#include "renderer/image/colour_map.h"
#include "renderer/image/text.h"

namespace minkray {
namespace {

Vec3<float> from_codes(int red, int green, int blue) {
  const auto linear = [](int code) { return static_cast<float>(from_srgb(code / 255.0)); };
  return {linear(red), linear(green), linear(blue)};
}

/// Okabe and Ito's colours (2008), which are distinguishable with colour blindness; a solver that
/// did not converge must be the most conspicuous.
Vec3<float> status_colour(Status status) {
  switch (status) {
    case Status::miss:
      return from_codes(40, 44, 52);
    case Status::hit:
      return from_codes(86, 180, 233);
    case Status::inside:
      return from_codes(240, 228, 66);
    case Status::exhausted:
      return from_codes(213, 94, 0);
  }
  return Vec3<float>::Zero();
}

struct Layout {
  double scale;  ///< of the text
  int gap;
  int panel_width, panel_height, title_height, legend_height;
  int width, height;

  Layout(const std::vector<HeatPanel>& panels) {
    panel_width = panels.front().field->width;
    panel_height = panels.front().field->height;
    const auto count = static_cast<int>(panels.size());
    scale = std::clamp(panel_height / 300.0, 1.5, 4.0);
    gap = static_cast<int>(8 * scale);
    title_height = panels.front().title.empty() ? 0 : static_cast<int>(16 * scale);
    legend_height = static_cast<int>(48 * scale);
    const int least_width = static_cast<int>(240 * scale);  // room for the legend's words
    width = std::max(count * panel_width + (count - 1) * gap, least_width);
    height = title_height + panel_height + legend_height;
  }
};

/// The numbers that a scale from 0 to `most` shows: a handful, round ones.
std::vector<double> ticks(double most) {
  double step = std::pow(10, std::floor(std::log10(std::max(most, 1.0) / 4)));
  for (const double factor : {1.0, 2.0, 5.0, 10.0})
    if (most / (factor * step) <= 6) {
      step *= factor;
      break;
    }
  step = std::max(step, 1.0);
  std::vector<double> result;
  for (int i = 0; i * step <= most; ++i) result.push_back(i * step);
  return result;
}

void draw_scale(Image& image, const Layout& layout, double most, std::string_view unit) {
  const Vec3<float> ink = from_codes(230, 230, 230);
  const double s = layout.scale, left = 12 * s, right = layout.width - 12 * s;
  const double top = layout.title_height + layout.panel_height + 8 * s, bottom = top + 10 * s;
  for (int x = static_cast<int>(left); x < static_cast<int>(right); ++x)
    fill_rectangle(image, x, top, x + 1, bottom, inferno((x + 0.5 - left) / (right - left)));
  for (const double tick : ticks(most)) {
    const double x = left + (right - left) * (most > 0 ? tick / most : 0);
    fill_rectangle(image, x - s / 4, bottom, x + s / 4, bottom + 3 * s, ink);
    char number[32];
    std::snprintf(number, sizeof number, "%.6g", tick);
    const double width = text_size(number, s).width;
    draw_text(image, std::min(x - width / 2, layout.width - width), bottom + 5 * s, number, ink, s);
  }
  char range[64];
  std::snprintf(range, sizeof range, "   (largest: %.6g)", most);
  const std::string caption = std::string(unit) + range;
  draw_text(image, (layout.width - text_size(caption, s).width) / 2, bottom + 18 * s, caption, ink,
            s);
}

void draw_status_legend(Image& image, const Layout& layout) {
  const Vec3<float> ink = from_codes(230, 230, 230);
  const double s = layout.scale, top = layout.title_height + layout.panel_height + 12 * s;
  double x = 12 * s;
  for (const Status status : heat_statuses) {
    fill_rectangle(image, x - 1, top - 1, x + 12 * s + 1, top + 12 * s + 1, ink);
    fill_rectangle(image, x, top, x + 12 * s, top + 12 * s, status_colour(status));
    draw_text(image, x + 16 * s, top + 3 * s, name_of(status), ink, s);
    x += 24 * s + text_size(name_of(status), s).width;
  }
}

}  // namespace

Image heat_picture(const std::vector<HeatPanel>& panels, HeatChannel channel) {
  const Layout layout(panels);
  Image image(layout.width, layout.height, from_codes(24, 26, 30));
  double most = 0;
  for (const HeatPanel& panel : panels) most = std::max(most, summary_of(*panel.field).most);

  int left = 0;
  for (const HeatPanel& panel : panels) {
    draw_text(image, left + 4 * layout.scale, 4 * layout.scale, panel.title,
              from_codes(230, 230, 230), layout.scale);
    for (int y = 0; y < layout.panel_height; ++y)
      for (int x = 0; x < layout.panel_width; ++x) {
        const float value = panel.field->values[static_cast<std::size_t>(y) *
                                                    static_cast<std::size_t>(layout.panel_width) +
                                                static_cast<std::size_t>(x)];
        image.at(left + x, layout.title_height + y) =
            channel == HeatChannel::status
                ? status_colour(heat_statuses[static_cast<std::size_t>(value)])
                : inferno(most > 0 ? static_cast<double>(value) / most : 0);
      }
    left += layout.panel_width + layout.gap;
  }

  if (channel == HeatChannel::status)
    draw_status_legend(image, layout);
  else
    draw_scale(image, layout, most, description_of(channel).unit);
  return image;
}

Image heat_numbers(const std::vector<HeatPanel>& panels) {
  const HeatField& first = *panels.front().field;
  Image image(first.width * static_cast<int>(panels.size()), first.height);
  int left = 0;
  for (const HeatPanel& panel : panels) {
    for (int y = 0; y < first.height; ++y)
      for (int x = 0; x < first.width; ++x)
        image.at(left + x, y)
            .setConstant(panel.field->values[static_cast<std::size_t>(y) *
                                                 static_cast<std::size_t>(first.width) +
                                             static_cast<std::size_t>(x)]);
    left += first.width;
  }
  return image;
}

}  // namespace minkray
