// SPDX-License-Identifier: MIT
#include "renderer/image/filter.h"

#include <cmath>
#include <numbers>

namespace minkray {
namespace {

// Harris, "On the use of windows for harmonic analysis" (1978): the 4-term, 92 dB window.
constexpr double a0 = 0.35875, a1 = 0.48829, a2 = 0.14128, a3 = 0.01168;

/// The integral of the normalised window from its left end to the fraction x of its width.
double window_integral(double x) {
  const double turn = 2 * std::numbers::pi * x;
  return x - (a1 * std::sin(turn) - a2 / 2 * std::sin(2 * turn) + a3 / 3 * std::sin(3 * turn)) /
                 (2 * std::numbers::pi * a0);
}

}  // namespace

PixelFilter::PixelFilter() {
  for (std::size_t i = 0; i <= steps_; ++i)
    cumulative_[i] = window_integral(static_cast<double>(i) / steps_);
  cumulative_.front() = 0;
  cumulative_.back() = 1;
  std::size_t above = 1;
  for (std::size_t i = 0; i < cells_; ++i) {
    while (above < steps_ && cumulative_[above] <= static_cast<double>(i) / cells_) ++above;
    first_above_[i] = static_cast<std::uint16_t>(above);
  }
}

double PixelFilter::weight(double offset) {
  if (!(std::abs(offset) < radius)) return 0;
  const double turn = 2 * std::numbers::pi * (0.5 + offset / (2 * radius));
  return (a0 - a1 * std::cos(turn) + a2 * std::cos(2 * turn) - a3 * std::cos(3 * turn)) /
         (2 * radius * a0);
}

double PixelFilter::offset(double u) const {
  std::size_t above = first_above_[static_cast<std::size_t>(u * cells_)];
  while (above < steps_ && cumulative_[above] <= u) ++above;
  const double low = cumulative_[above - 1], high = cumulative_[above];
  const double step = static_cast<double>(above - 1) + (u - low) / (high - low);
  return radius * (2 * step / steps_ - 1);
}

}  // namespace minkray
