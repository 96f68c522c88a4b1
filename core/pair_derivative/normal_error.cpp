// SPDX-License-Identifier: MIT
#include "core/pair_derivative/normal_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/pair/face_corners.h"
#include "core/pair/flat_part.h"

namespace minkray {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double rounding = 16 * epsilon;  // rounding of a normal

/// Compares n with the direction of `way`, whose error is at most `off`.
double by_direction(const Vec3<double>& way, const Vec3<double>& n, double off) {
  const double length = way.norm();
  if (!(length > off)) return infinity;
  return (way / length - n).norm() + off / (length - off) + rounding;
}

/// Uses two facts. The grown core contains a ball of the core's radius that touches the surface at
/// the true point. No point is above the plane through the support point.
double by_support(const ShapeCore& core, const Vec3<double>& foot, const Vec3<double>& n,
                  double off) {
  const double furthest = n.dot(support_of_core<CoreKind::other>(core, n).point);
  const double gap = furthest - n.dot(foot) + 8 * epsilon * (core.ball + core.radius);
  return std::sqrt(2 * (std::max(gap, 0.0) + off) / core.radius) + rounding;
}

/// Uses that no corner of the face under `foot` is above the plane perpendicular to the true normal
/// through a certain point of the hull. That point is within `off` of `foot`.
double on_face(const ShapeCore& core, const Vec3<double>& foot, const Vec3<double>& n, double off) {
  const double near = off + flat_face * core.ball;
  double lowest = infinity, highest = -infinity;
  std::vector<PlaneCorner>& corners = face_corners(core, foot, n, [&](double height) {
    highest = std::max(highest, height);
    if (height < -near) return false;
    lowest = std::min(lowest, height);
    return true;
  });
  if (corners.size() < 3) return infinity;
  sort_round(corners);
  // The polygon of the corners in this order is part of the face.
  double inner = infinity;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlaneCorner &a = corners[i], &b = corners[i + 1 < corners.size() ? i + 1 : 0];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    // Skips the copies that fill up a hull's points.
    if (length > 0) inner = std::min(inner, (a.x * b.y - a.y * b.x) / length);
  }
  const double free = inner - off;
  if (!(free > 0)) return infinity;
  return (highest - lowest + 16 * epsilon * core.ball) / free + rounding;
}

double of_hull(const ShapeCore& core, const Vec3<double>& point, const Vec3<double>& n,
               double off) {
  if (!(core.radius > 0)) return on_face(core, point, n, off);
  const Vec3<double> foot = point - core.radius * n;
  const double tilt = by_support(core, foot, n, off);
  const FlatPart part = flat_part(core, n, tilt);
  if (part.dimension == 2) return std::min(tilt, on_face(core, foot, n, off + core.radius * tilt));
  const Vec3<double> corner = support_of_core<CoreKind::hull>(core, n).point;
  if (part.dimension == 0) return std::min(tilt, by_direction(point - corner, n, off));
  const double along = part.along.dot(point - corner);
  if (!(along > off && along < part.length - off)) return tilt;
  return std::min(tilt, by_direction(point - corner - along * part.along, n, off));
}

double of_box(const ShapeCore& core, const Vec3<double>& point, const Vec3<double>& n, double off) {
  if (core.radius > 0) {
    const Vec3<double> nearest = point.cwiseMin(core.size).cwiseMax(-core.size);
    return by_direction(point - nearest, n, off);
  }
  int faces = 0, face = 0;
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(std::abs(point[i]) - core.size[i]) <= off)) continue;
    ++faces;
    face = i;
  }
  if (faces != 1) return infinity;
  return (std::copysign(1.0, n[face]) * Vec3<double>::Unit(face) - n).norm() + rounding;
}

/// In the half plane through its axis and the point, a core of disks has three sides.
double of_disks(const ShapeCore& core, const Vec3<double>& point, const Vec3<double>& n,
                double off) {
  struct Place {
    double across, z;
  };
  const double across = std::hypot(point.x(), point.y());
  const double below = core.size.x(), above = core.size.y(), height = core.size.z();
  const double rise = 2 * height, widening = above - below, side = std::hypot(rise, widening);
  const double part =
      side > 0 ? std::clamp(((across - below) * widening + (point.z() + height) * rise) / side, 0.0,
                            side)
               : 0;
  const Place feet[3] = {{std::min(across, below), -height},
                         {std::min(across, above), height},
                         {below + (side > 0 ? part * widening / side : 0),
                          -height + (side > 0 ? part * rise / side : 0)}};
  const auto way_to = [&](const Place& foot) -> Vec3<double> {
    const double k = across > 0 ? (across - foot.across) / across : 0;
    return {k * point.x(), k * point.y(), point.z() - foot.z};
  };
  if (core.radius > 0) {
    Vec3<double> way = way_to(feet[0]);
    for (const Place& foot : feet)
      if (way_to(foot).squaredNorm() < way.squaredNorm()) way = way_to(foot);
    return by_direction(way, n, off);
  }
  bool is_on[3];
  for (int i = 0; i < 3; ++i) is_on[i] = way_to(feet[i]).norm() <= off;
  if (is_on[2] == (is_on[0] || is_on[1])) {
    // The two faces of a disk coincide.
    if (!is_on[2] || height > 0) return infinity;
  }
  if (!is_on[2] || !(height > 0))
    return (Vec3<double>(0, 0, std::copysign(1.0, n.z())) - n).norm() + rounding;
  if (!(across > off)) return infinity;
  const double slope = rise / side;
  const Vec3<double> own(slope * point.x() / across, slope * point.y() / across, -widening / side);
  return (own - n).norm() + slope * off / (across - off) + rounding;
}

/// The normal is the direction of the gradient p/a^2. The gradient's error is at most `off` divided
/// by the square of the least radius.
double of_ellipsoid(const ShapeCore& core, const Vec3<double>& point, const Vec3<double>& n,
                    double off) {
  const double least = core.size.minCoeff();
  if (!(least > 0)) return infinity;
  if (core.radius > 0) return by_support(core, point - core.radius * n, n, off);
  const Vec3<double> gradient = point.cwiseQuotient(core.size).cwiseQuotient(core.size);
  return by_direction(gradient, n, off / (least * least));
}

}  // namespace

double normal_error_at(const ShapeCore& core, const Vec3<double>& point, const Vec3<double>& n,
                       double off) {
  switch (core.kind) {
    case CoreKind::point:
      return by_direction(point, n, off);
    case CoreKind::segment: {
      const double z = std::clamp(point.z(), -core.size.z(), core.size.z());
      return by_direction(point - Vec3<double>(0, 0, z), n, off);
    }
    case CoreKind::box:
      return of_box(core, point, n, off);
    case CoreKind::hull:
      return of_hull(core, point, n, off);
    case CoreKind::disks:
      return of_disks(core, point, n, off);
    case CoreKind::ellipsoid:
      return of_ellipsoid(core, point, n, off);
    case CoreKind::other:
      break;
  }
  if (!(core.radius > 0)) return infinity;
  return by_support(core, point - core.radius * n, n, off);
}

}  // namespace minkray
