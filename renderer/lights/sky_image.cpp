// SPDX-License-Identifier: MIT
#include "renderer/lights/sky_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace minkray {
namespace {

using std::numbers::pi;

/// No more cells of latitude: each takes 24 bytes, twice as many of longitude.
constexpr int most_rows = 1024;

/// The part of the sphere between two rows' edges, over 2 pi.
double band(int row, int rows) {
  return std::cos(pi * row / rows) - std::cos(pi * (row + 1) / rows);
}

/// Brightness of each cell, times its solid angle. Places between pixels are interpolated from
/// their neighbours, so that each cell counts those around it, too.
std::vector<double> weights_of(const Image& image, int columns, int rows) {
  std::vector<double> bright(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const auto pixel_of = [](int cell, int cells, int pixels) {
    return static_cast<int>(std::int64_t{cell} * pixels / cells);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      double sum = 0;
      int count = 0;
      const int y0 = pixel_of(row, rows, image.height) - 1;
      const int y1 = pixel_of(row + 1, rows, image.height) + 1;
      const int x0 = pixel_of(column, columns, image.width) - 1;
      const int x1 = pixel_of(column + 1, columns, image.width) + 1;
      for (int y = std::max(y0, 0); y < std::min(y1, image.height); ++y)
        for (int x = x0; x < x1; ++x, ++count)
          sum += static_cast<double>(image.at((x + image.width) % image.width, y).mean());
      bright[static_cast<std::size_t>(row * columns + column)] =
          sum / std::max(count, 1) * band(row, rows);
    }
  return bright;
}

}  // namespace

SkyImage::SkyImage(std::shared_ptr<const Image> image, double strength, double turn)
    : image_(std::move(image)),
      strength_(strength),
      turn_(turn),
      columns_(std::min(image_->width, 2 * most_rows)),
      rows_(std::min(image_->height, most_rows)),
      cells_(weights_of(*image_, columns_, rows_)) {}

Colour SkyImage::texel(int x, int y) const {
  const int width = image_->width;
  return image_->at(((x % width) + width) % width, std::clamp(y, 0, image_->height - 1))
      .cast<double>();
}

std::array<double, 2> SkyImage::place(const Vec3<double>& direction) const {
  const double around = (std::atan2(direction.x(), direction.y()) + turn_) / (2 * pi) + 0.5;
  return {around - std::floor(around), std::acos(std::clamp(direction.z(), -1.0, 1.0)) / pi};
}

Colour SkyImage::eval(const Vec3<double>& direction) const {
  const auto [u, v] = place(direction);
  const double x = u * image_->width - 0.5, y = v * image_->height - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double fx = x - x0, fy = y - y0;
  const Colour upper = (1 - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0);
  const Colour lower = (1 - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1);
  return strength_ * ((1 - fy) * upper + fy * lower);
}

std::size_t SkyImage::cell_of(const Vec3<double>& direction) const {
  const auto [u, v] = place(direction);
  const int column = std::min(static_cast<int>(u * columns_), columns_ - 1);
  const int row = std::min(static_cast<int>(v * rows_), rows_ - 1);
  return static_cast<std::size_t>(row * columns_ + column);
}

std::optional<LightSample> SkyImage::sample(const Vec3<double>& point, Sampler& sampler) const {
  const auto cell = static_cast<int>(cells_.draw(sampler.next()[0]));
  const std::array<double, 2> within = sampler.next();
  const int row = cell / columns_, column = cell % columns_;
  const double z = std::cos(pi * row / rows_) - within[0] * band(row, rows_);
  const double radius = std::sqrt(std::max(1 - z * z, 0.0));
  const double angle = 2 * pi * ((column + within[1]) / columns_ - 0.5) - turn_;
  const Vec3<double> direction(radius * std::sin(angle), radius * std::cos(angle), z);
  const double density = pdf(point, direction);
  if (!(density > 0)) return std::nullopt;
  return LightSample{direction, std::numeric_limits<double>::infinity(), eval(direction) / density};
}

double SkyImage::pdf(const Vec3<double>&, const Vec3<double>& direction) const {
  const std::size_t cell = cell_of(direction);
  const int row = static_cast<int>(cell) / columns_;
  return cells_.chance(cell) / (2 * pi / columns_ * band(row, rows_));
}

}  // namespace minkray
