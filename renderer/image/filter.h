// SPDX-License-Identifier: MIT
// Pixel reconstruction filter by importance sampling (Ernst, Stamminger and Greiner, "Filter
// Importance Sampling", 2006): samples are distributed by the filter and weighted equally, so
// pixels share no samples and can be rendered in any order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace minkray {

/// The separable Blackman-Harris window: smooth, positive, hardly any ringing or blur.
class PixelFilter {
 public:
  /// Half the width of the support, in pixels: its standard deviation is then 0.42 pixels, which is
  /// that of the usual Gaussian filters.
  static constexpr double radius = 1.5;

  PixelFilter();

  /// The weight at an offset from the pixel's centre; its integral is 1.
  static double weight(double offset);

  /// The offset below which a fraction u in [0, 1) of the weight lies.
  double offset(double u) const;

 private:
  static constexpr std::size_t steps_ = 1024;
  static constexpr std::size_t cells_ = 1024;
  std::array<double, steps_ + 1> cumulative_;
  /// For each cell of u: the first step that may reach beyond u (Chen and Asau's guide table,
  /// 1974).
  std::array<std::uint16_t, cells_> first_above_;
};

}  // namespace minkray
