// SPDX-License-Identifier: MIT
// Makes the cores (core_and_radius.h) of simple shapes: points, segments, hulls of points, disks.
#pragma once

#include <algorithm>

#include "core/derived/about_middle.h"
#include "core/derived/core_and_radius.h"
#include "core/math/length.h"

namespace minkray::cores {

/// Factor by which radii of balls are rounded up, so that the balls contain their cores.
inline constexpr double padding = 1 + 16 * std::numeric_limits<double>::epsilon();

/// Puts a core at a pose. `middle` is the origin of the core's frame, and `loss` its error bound.
inline CoreAndRadius placed(ShapeCore core, const Mat3<double>& turn,
                            const TwoFoldVec3<double>& middle, double loss) {
  core.rounding += loss;
  return {std::move(core), turn, middle.high, middle.low, nullptr};
}

inline CoreAndRadius of_point(const TwoFoldVec3<double>& point, double radius, double loss) {
  ShapeCore core;
  core.radius = radius;
  return placed(core, Mat3<double>::Identity(), point, loss);
}

inline CoreAndRadius of_segment(const TwoFoldVec3<double>& from, const TwoFoldVec3<double>& to,
                                double radius, double loss) {
  const Vec3<double> half = (to - from).rounded() / 2;
  const double length = half.stableNorm();
  if (!(length > 0)) return of_point(from, radius, loss);
  ShapeCore core;
  core.kind = CoreKind::segment;
  core.size.z() = length;
  core.radius = radius;
  core.ball = length * padding;
  Mat3<double> turn;
  turn.col(2) = half / length;
  turn.col(0) = turn.col(2).unitOrthogonal();
  turn.col(1) = turn.col(2).cross(turn.col(0));
  return placed(core, turn, from + TwoFoldVec3<double>(half), loss);
}

/// The hull of points under a map.
inline CoreAndRadius of_points(const std::vector<Vec3<double>>& points, const ComposedMap& map,
                               double radius) {
  const PointsAboutMiddle about = points_about_middle(points, map);
  if (points.size() == 1) return of_point(map.image(points[0]), radius, about.loss);
  if (points.size() == 2)
    return of_segment(map.image(points[0]), map.image(points[1]), radius, about.loss);
  const std::size_t count = (points.size() + 7) / 8 * 8;
  auto numbers = std::make_shared<std::vector<double>>(3 * count);
  ShapeCore core;
  core.kind = CoreKind::hull;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3<double>& p = about.points[std::min(i, points.size() - 1)];
    core.ball = std::max(core.ball, length_of<double>(p) * padding);
    for (std::size_t k = 0; k < 3; ++k) (*numbers)[k * count + i] = p[static_cast<Eigen::Index>(k)];
  }
  core.count = static_cast<int>(count);
  core.radius = radius;
  core.x = numbers->data();
  core.y = core.x + count;
  core.z = core.y + count;
  CoreAndRadius found = placed(core, Mat3<double>::Identity(), about.middle, about.loss);
  found.storage = std::move(numbers);
  return found;
}

inline ShapeCore of_disks(double below, double above, double half_height) {
  ShapeCore core;
  core.kind = CoreKind::disks;
  core.size = {below, above, half_height};
  core.ball = std::hypot(std::max(below, above), half_height) * padding;
  return core;
}

}  // namespace minkray::cores
