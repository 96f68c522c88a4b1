// SPDX-License-Identifier: MIT
#include "renderer/image/pyramid.h"

#include <algorithm>
#include <cmath>

namespace minkray {
namespace {

/// One of the pixels that a pixel of half the size covers, and which part of that it is.
struct Covered {
  int pixel;
  float part;
};

/// For each pixel of a row of `count`: the pixels of a row of `of` that it covers, at most three.
std::vector<std::vector<Covered>> covered_by(int count, int of) {
  std::vector<std::vector<Covered>> covered(static_cast<std::size_t>(count));
  const double size = static_cast<double>(of) / count;
  for (int i = 0; i < count; ++i) {
    const double begin = i * size, end = i + 1 == count ? of : (i + 1) * size;
    for (int pixel = static_cast<int>(begin); pixel < end && pixel < of; ++pixel) {
      const double part = (std::min(end, pixel + 1.0) - std::max(begin, double(pixel))) / size;
      if (part > 0) covered[static_cast<std::size_t>(i)].push_back({pixel, float(part)});
    }
  }
  return covered;
}

Image halved(const Image& image) {
  Image half((image.width + 1) / 2, (image.height + 1) / 2);
  const auto columns = covered_by(half.width, image.width);
  const auto rows = covered_by(half.height, image.height);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      Vec3<float>& sum = half.at(x, y);
      for (const Covered& row : rows[static_cast<std::size_t>(y)])
        for (const Covered& column : columns[static_cast<std::size_t>(x)])
          sum += row.part * column.part * image.at(column.pixel, row.pixel).cwiseMin(1.0F);
    }
  return half;
}

}  // namespace

std::vector<Image> smaller_images(const Image& image) {
  std::vector<Image> smaller;
  if (image.pixels.empty()) return smaller;
  const Image* last = &image;
  while (last->width > 1 || last->height > 1) {
    smaller.push_back(halved(*last));
    last = &smaller.back();
  }
  return smaller;
}

}  // namespace minkray
