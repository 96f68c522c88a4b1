// SPDX-License-Identifier: MIT
#include "core/contact/closed_pairs.h"

#include <algorithm>

namespace minkray {
namespace {

CoreDistance exact(double distance, const Vec3<double>& axis, const Vec3<double>& a,
                   const Vec3<double>& c) {
  CoreDistance result;
  result.status = distance > 0 ? CoreStatus::separated : CoreStatus::overlapping;
  result.lower = result.upper = distance;
  result.axis = axis;
  result.a = a;
  result.c = c;
  return result;
}

/// c's direction; where there is none, `otherwise`.
CoreDistance exact_between(const Vec3<double>& a, const Vec3<double>& c,
                           const Vec3<double>& otherwise) {
  const Vec3<double> direction = unit<double>(c);
  return exact(c.stableNorm(), direction.isZero(0) ? otherwise : direction, a, c);
}

/// The parameter, from -1 to 1, of the point of the segment from -half to +half nearest to p.
double nearest_on_segment(const Vec3<double>& half, const Vec3<double>& p) {
  const double squared = half.squaredNorm();
  return squared > 0 ? std::clamp(p.dot(half) / squared, -1.0, 1.0) : 0;
}

/// Segments -p to p, and x - q to x + q; either may be a point.
CoreDistance between_segments(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x) {
  // The nearest points are within both, or one of them is an end.
  const Vec3<double> n = p.cross(q);
  const double squared = n.squaredNorm();
  Vec3<double> across = Vec3<double>::UnitX();
  if (squared > 0)
    across = n / std::sqrt(squared);
  else if (p.squaredNorm() > 0)
    across = p.unitOrthogonal();
  else if (q.squaredNorm() > 0)
    across = q.unitOrthogonal();
  if (squared > 0) {
    const double s = x.cross(q).dot(n) / squared, t = x.cross(p).dot(n) / squared;
    if (std::abs(s) <= 1 && std::abs(t) <= 1) {
      const double gap = x.dot(across);
      const Vec3<double> axis = gap < 0 ? Vec3<double>(-across) : across;
      return exact(std::abs(gap), axis, s * p, std::abs(gap) * axis);
    }
  }
  Vec3<double> a = Vec3<double>::Zero(), c = Vec3<double>::Zero();
  double best = std::numeric_limits<double>::infinity(), on_a = 0, on_b = 0;
  const auto try_points = [&](double s, double t) {
    const Vec3<double> between = x + t * q - s * p;
    const double length = between.squaredNorm();
    if (!(length < best)) return;
    best = length;
    a = s * p;
    c = between;
    on_a = s;
    on_b = t;
  };
  for (const double end : {-1.0, 1.0}) {
    try_points(nearest_on_segment(p, x + end * q), end);
    try_points(end, nearest_on_segment(q, end * p - x));
  }
  // No point of A is further along the axis, and none of B less far. Where c is as good as zero,
  // its direction is one of rounding: that is taken out, twice, since the first time leaves some.
  Vec3<double> axis = unit<double>(c);
  for (int i = 0; i < 2; ++i) {
    const double along_a = axis.dot(p), along_b = axis.dot(q);
    if (p.squaredNorm() > 0 && (std::abs(on_a) < 1 || on_a * along_a < 0))
      axis -= (along_a / p.squaredNorm()) * p;
    if (q.squaredNorm() > 0 && (std::abs(on_b) < 1 || on_b * along_b > 0))
      axis -= (axis.dot(q) / q.squaredNorm()) * q;
    axis = axis.squaredNorm() > 0.25 ? Vec3<double>(axis.normalized()) : across;
  }
  return exact(c.stableNorm(), axis, a, c);
}

/// A point p against a box; c goes from the box to the point, or inside of it to the nearest face.
CoreDistance point_and_box(const Vec3<double>& half, const Vec3<double>& p) {
  const Vec3<double> nearest = p.cwiseMax(-half).cwiseMin(half);
  if (nearest != p) return exact_between(nearest, p - nearest, Vec3<double>::UnitX());
  int face = 0;
  const Vec3<double> inside = half - p.cwiseAbs();
  inside.minCoeff(&face);
  const Vec3<double> axis = Vec3<double>::Unit(face) * (p[face] < 0 ? -1 : 1);
  Vec3<double> on_face = p;
  on_face[face] = half[face] * (p[face] < 0 ? -1 : 1);
  return exact(-inside[face], axis, on_face, p - on_face);
}

bool is_line(const ShapeCore& core) {
  return core.kind == CoreKind::point || core.kind == CoreKind::segment;
}

}  // namespace

bool closed_distance(const CorePair& pair, CoreDistance& found) {
  const ShapeCore &a = pair.a, &b = pair.b;
  if (is_line(a) && is_line(b)) {
    found = between_segments({0, 0, a.size.z()}, pair.turn.col(2) * b.size.z(), pair.x);
    return true;
  }
  if (a.kind == CoreKind::box && b.kind == CoreKind::point) {
    found = point_and_box(a.size, pair.x);
    return true;
  }
  if (a.kind == CoreKind::point && b.kind == CoreKind::box) {
    // As the box sees it: from the box to the point.
    found = point_and_box(b.size, pair.to_b(-pair.x));
    found.axis = pair.turn * -found.axis;
    found.c = pair.turn * -found.c;
    found.a.setZero();
    return true;
  }
  return false;
}

CoreDistance box_overlap(const CorePair& pair) {
  const Vec3<double>&a = pair.a.size, &b = pair.b.size, &x = pair.x;
  const Mat3<double>& R = pair.turn;
  const Mat3<double> Q = R.cwiseAbs();
  CoreDistance result;
  const auto try_axis = [&](double gap, const auto& axis_of) {
    if (gap > result.lower) result.raise_lower(gap, axis_of());
  };
  for (int i = 0; i < 3; ++i)
    try_axis(std::abs(x[i]) - a[i] - Q.row(i).dot(b),
             [&]() -> Vec3<double> { return Vec3<double>::Unit(i) * (x[i] < 0 ? -1 : 1); });
  for (int j = 0; j < 3; ++j) {
    const double along = R.col(j).dot(x);
    try_axis(std::abs(along) - b[j] - Q.col(j).dot(a),
             [&]() -> Vec3<double> { return R.col(j) * (along < 0 ? -1 : 1); });
  }
  // Edges as good as parallel cross no better than faces do.
  constexpr double least_squared_sine = 1e-12;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double squared = 1 - R(i, j) * R(i, j);
      if (squared < least_squared_sine) continue;
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double along = x[i2] * R(i1, j) - x[i1] * R(i2, j);
      const double reach =
          a[i1] * Q(i2, j) + a[i2] * Q(i1, j) + b[j1] * Q(i, j2) + b[j2] * Q(i, j1);
      const double gap = (std::abs(along) - reach) / std::sqrt(squared);
      try_axis(gap, [&]() -> Vec3<double> {
        const Vec3<double> n = Vec3<double>::Unit(i).cross(R.col(j)).normalized();
        return n * (n.dot(x) < 0 ? -1 : 1);
      });
    }
  result.status = result.lower > 0 ? CoreStatus::separated : CoreStatus::overlapping;
  result.upper = result.lower;
  return result;
}

}  // namespace minkray
