// SPDX-License-Identifier: MIT
// Tests if directions that are drawn at random have the claimed density: the sphere is cut into
// cells, and the number drawn into each is compared with the density's integral over it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/math/vec.h"
#include "renderer/rays/sampler.h"

namespace minkray {

struct DensityCheck {
  double total;           ///< the density's integral over the sphere
  double drawn;           ///< part of the draws that gave a direction
  double largest_excess;  ///< of a cell's drawn part over its integral, in standard deviations
  int cells;              ///< number of cells with at least one expected draw in 2000
};

/// draw(sampler) is a direction or nothing, pdf(direction) its density over solid angle. Cells are
/// bands of z, in which solid angle is even, by bands of the angle around z.
template <class Draw, class Pdf>
DensityCheck check_density(const Draw& draw, const Pdf& pdf, int draws = 1 << 18) {
  constexpr int rows = 32, columns = 16, steps = 48;
  constexpr double pi = std::numbers::pi;
  std::vector<double> expected(rows * columns), drawn(rows * columns);
  DensityCheck check{0, 0, 0, 0};
  for (int row = 0; row < rows * steps; ++row)
    for (int column = 0; column < columns * steps; ++column) {
      const double z = -1 + 2 * (row + 0.5) / (rows * steps);
      const double angle = 2 * pi * (column + 0.5) / (columns * steps);
      const double r = std::sqrt(1 - z * z);
      const double part = pdf(Vec3<double>(r * std::cos(angle), r * std::sin(angle), z)) * 4 * pi /
                          (rows * steps * columns * steps);
      expected[static_cast<std::size_t>(row / steps * columns + column / steps)] += part;
      check.total += part;
    }
  for (int i = 0; i < draws; ++i) {
    Sampler sampler(11, 0, 0, static_cast<std::uint32_t>(i));
    const std::optional<Vec3<double>> direction = draw(sampler);
    if (!direction) continue;
    const int row = std::clamp(static_cast<int>((direction->z() + 1) / 2 * rows), 0, rows - 1);
    const double turn = std::atan2(direction->y(), direction->x()) / (2 * pi);
    const int column =
        std::clamp(static_cast<int>((turn < 0 ? turn + 1 : turn) * columns), 0, columns - 1);
    drawn[static_cast<std::size_t>(row * columns + column)] += 1.0 / draws;
    check.drawn += 1.0 / draws;
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double p = std::max(expected[i], 1.0 / 2000);
    check.largest_excess = std::max(
        check.largest_excess, std::abs(drawn[i] - expected[i]) / std::sqrt(p * (1 - p) / draws));
    check.cells += expected[i] > 1.0 / 2000 ? 1 : 0;
  }
  return check;
}

/// Draws are no further from what is expected than chance makes those of 512 cells once in 3000
/// times; they are spread more evenly than by chance.
inline void expect_density(const DensityCheck& check) {
  EXPECT_NEAR(check.total, 1, 1e-3);
  EXPECT_NEAR(check.drawn, 1, 1e-3);
  EXPECT_LT(check.largest_excess, 5);
  EXPECT_GT(check.cells, 50);
}

}  // namespace minkray
