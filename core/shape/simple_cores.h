// SPDX-License-Identifier: MIT
// Cores made of plain numbers: points, segments, hulls of points, disks.
#pragma once

#include <algorithm>

#include "core/math/length.h"
#include "core/shape/core_and_radius.h"

namespace minkray::cores {

/// A box's and ellipsoid's balls are rounded up, so that they hold what they should.
inline constexpr double padding = 1 + 16 * std::numeric_limits<double>::epsilon();

inline CoreAndRadius placed(const ShapeCore& core, const Mat3<double>& turn,
                            const Vec3<double>& middle) {
  return {core, turn, middle, nullptr};
}

inline CoreAndRadius of_point(const Vec3<double>& point, double radius) {
  ShapeCore core;
  core.radius = radius;
  return {core, Mat3<double>::Identity(), point, nullptr};
}

inline CoreAndRadius of_segment(const Vec3<double>& from, const Vec3<double>& to, double radius) {
  // Halves of differences, so that what is far from the origin keeps its digits.
  const Vec3<double> half = (to - from) / 2;
  const double length = half.stableNorm();
  if (!(length > 0)) return of_point(from, radius);
  ShapeCore core;
  core.kind = CoreKind::segment;
  core.size.z() = length;
  core.radius = radius;
  core.ball = length * padding;
  Mat3<double> turn;
  turn.col(2) = half / length;
  turn.col(0) = turn.col(2).unitOrthogonal();
  turn.col(1) = turn.col(2).cross(turn.col(0));
  return {core, turn, from + half, nullptr};
}

/// The points' middle is that of their box.
inline CoreAndRadius of_points(const std::vector<Vec3<double>>& points, double radius) {
  if (points.size() == 1) return of_point(points[0], radius);
  if (points.size() == 2) return of_segment(points[0], points[1], radius);
  Vec3<double> low = points[0], high = points[0];
  for (const Vec3<double>& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3<double> middle = low + (high - low) / 2;
  const std::size_t count = (points.size() + 7) / 8 * 8;
  auto numbers = std::make_shared<std::vector<double>>(3 * count);
  ShapeCore core;
  core.kind = CoreKind::hull;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3<double> p = points[std::min(i, points.size() - 1)] - middle;
    core.ball = std::max(core.ball, length_of<double>(p) * padding);
    for (std::size_t k = 0; k < 3; ++k) (*numbers)[k * count + i] = p[static_cast<Eigen::Index>(k)];
  }
  core.count = static_cast<int>(count);
  core.radius = radius;
  core.x = numbers->data();
  core.y = core.x + count;
  core.z = core.y + count;
  return {core, Mat3<double>::Identity(), middle, std::move(numbers)};
}

inline ShapeCore of_disks(double below, double above, double half_height) {
  ShapeCore core;
  core.kind = CoreKind::disks;
  core.size = {below, above, half_height};
  core.ball = std::hypot(std::max(below, above), half_height) * padding;
  return core;
}

}  // namespace minkray::cores
