// SPDX-License-Identifier: MIT
// Pictures in memory: linear RGB, rows from the top.
#pragma once

#include <cstddef>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

/// Pixels x0 <= x < x1, y0 <= y < y1; y counts downwards.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return !(x0 < x1 && y0 < y1); }
  bool operator==(const PixelRect&) const = default;
};

struct Image {
  int width = 0;
  int height = 0;
  std::vector<Vec3<float>> pixels;

  Image() = default;
  Image(int w, int h, const Vec3<float>& fill = Vec3<float>::Zero())
      : width(w),
        height(h),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}

  Vec3<float>& at(int x, int y) { return pixels[index(x, y)]; }
  const Vec3<float>& at(int x, int y) const { return pixels[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

}  // namespace minkray
