// SPDX-License-Identifier: MIT
#include "renderer/field/field_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "renderer/image/colour_map.h"
#include "renderer/image/text.h"

namespace minkray {
namespace {

const Vec3<float> ink{0.8f, 0.8f, 0.8f}, ground{0.01f, 0.01f, 0.012f}, unknown{0.3f, 0.3f, 0.3f};

/// Scale of the picture's colours.
struct Scale {
  double least = 0, most = 0;  ///< of the values: least <= 0 <= most
  double step = 1;             ///< between lines of equal distance

  explicit Scale(const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    const double range = most - least;
    if (!(range > 0)) return;
    constexpr double lines = 12;
    const double decade = std::pow(10, std::floor(std::log10(range / lines)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
      step = factor * decade;
      if (range <= lines * step) break;
    }
  }

  Vec3<float> colour(double value) const {
    if (!(value < 0)) return inferno(most > 0 ? std::min(value / most, 1.0) : 0);
    const auto depth = static_cast<float>(value / least);
    const Vec3<float> shallow(0.02f, 0.05f, 0.2f), deep(0.35f, 0.65f, 1.0f);
    return shallow + depth * (deep - shallow);
  }
};

void draw_scale(Image& image, const Scale& scale, int top, double s, const std::string& title) {
  const double left = 12 * s, right = image.width - 12 * s, range = scale.most - scale.least;
  const double bar = top + 20 * s, bottom = bar + 10 * s;
  draw_text(image, left, top + 6 * s, title, ink, s);
  for (int x = static_cast<int>(left); x < static_cast<int>(right); ++x)
    fill_rectangle(image, x, bar, x + 1, bottom,
                   scale.colour(scale.least + range * (x + 0.5 - left) / (right - left)));
  if (!(range > 0)) return;
  // Every other line of equal distance, so that the numbers have room.
  const double every = 2 * scale.step;
  for (double k = std::ceil(scale.least / every); k * every <= scale.most; ++k) {
    const double x = left + (right - left) * (k * every - scale.least) / range;
    fill_rectangle(image, x - s / 4, bottom, x + s / 4, bottom + 3 * s, ink);
    char number[32];
    std::snprintf(number, sizeof number, "%.4g", k * every);
    const double width = text_size(number, s).width;
    draw_text(image, std::clamp(x - width / 2, 0.0, image.width - width), bottom + 5 * s, number,
              ink, s);
  }
}

}  // namespace

Image field_picture(const DistanceField& field, const std::string& title) {
  const int width = field.plane.width, height = field.plane.height;
  const double s = std::clamp(height / 300.0, 1.5, 4.0);
  Image image(std::max(width, static_cast<int>(200 * s)), height + static_cast<int>(48 * s),
              ground);
  const Scale scale(field.value);
  const auto pixel = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  };
  const auto value = [&](int x, int y) { return field.value[pixel(x, y)]; };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (field.is_unknown(pixel(x, y))) {
        image.at(x, y) = unknown;
        continue;
      }
      const double here = value(x, y);
      Vec3<float> colour = scale.colour(here);
      // A line passes between this pixel and the one to the right or below.
      for (const double other :
           {value(std::min(x + 1, width - 1), y), value(x, std::min(y + 1, height - 1))}) {
        if ((here < 0) != (other < 0)) {
          colour = Vec3<float>::Ones();
          break;
        }
        if (std::floor(here / scale.step) != std::floor(other / scale.step))
          colour = 0.65f * colour + 0.35f * Vec3<float>::Ones();
      }
      image.at(x, y) = colour;
    }
  draw_scale(image, scale, height, s, title);
  return image;
}

Image field_numbers(const DistanceField& field) {
  Image image(field.plane.width, field.plane.height);
  for (std::size_t i = 0; i < field.value.size(); ++i)
    image.pixels[i] = Vec3<double>(field.value[i], field.lower[i], field.upper[i]).cast<float>();
  return image;
}

}  // namespace minkray
