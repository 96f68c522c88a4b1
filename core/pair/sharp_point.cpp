// SPDX-License-Identifier: MIT
#include "core/pair/sharp_point.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/pair/face_corners.h"

namespace minkray {
namespace {

bool is_sharp_at_box(const ShapeCore& core, const Vec3<double>& point, double off) {
  int faces = 0;
  for (int i = 0; i < 3; ++i) faces += std::abs(point[i]) >= core.size[i] - off ? 1 : 0;
  return faces > 1;
}

/// True if the point is on a rim, or at the tip of a cone.
bool is_sharp_at_disks(const ShapeCore& core, const Vec3<double>& point, double off) {
  const double across = std::sqrt(point.x() * point.x() + point.y() * point.y());
  const auto is_at = [&](double rim, double z) {
    return std::abs(point.z() - z) <= off && std::abs(across - rim) <= off;
  };
  return is_at(core.size.x(), -core.size.z()) || is_at(core.size.y(), core.size.z());
}

/// True if the origin of three corners' coordinates is outside their triangle or on its rim.
bool is_on_rim(const std::vector<PlaneCorner>& corners, double near) {
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const PlaneCorner &a = corners[i], &b = corners[(i + 1) % 3];
    const double x = b.x - a.x, y = b.y - a.y;
    const double height = (a.x * b.y - a.y * b.x) / std::sqrt(x * x + y * y);
    left += height > near ? 1 : 0;
    right += height < -near ? 1 : 0;
  }
  return left < 3 && right < 3;
}

/// Uses the hull's points in the plane through `point`. `point` is sharp unless it is inside their
/// polygon.
bool is_sharp_at_hull(const ShapeCore& core, const Vec3<double>& point, const Vec3<double>& n,
                      double off) {
  const double near = off + flat_face * core.ball;
  std::vector<PlaneCorner>& corners =
      face_corners(core, point, n, [&](double height) { return std::abs(height) <= near; });
  for (const PlaneCorner& corner : corners)
    if (corner.x * corner.x + corner.y * corner.y <= near * near) return true;
  if (corners.size() < 3) return true;
  if (corners.size() == 3) return is_on_rim(corners, near);
  sort_round(corners);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlaneCorner &a = corners[i], &b = corners[i + 1 < corners.size() ? i + 1 : 0];
    const double angle = b.angle - a.angle + (i + 1 < corners.size() ? 0 : 2 * std::numbers::pi);
    if (angle >= std::numbers::pi) return true;
    if (a.x * b.y - a.y * b.x <= near * std::hypot(b.x - a.x, b.y - a.y) &&
        angle > std::numbers::pi / 2)
      return true;
  }
  return false;
}

}  // namespace

bool is_sharp_at(const ShapeCore& core, const Vec3<double>& point, const Vec3<double>& n,
                 double off) {
  switch (core.kind) {
    case CoreKind::point:
    case CoreKind::segment:
      return true;
    case CoreKind::box:
      return is_sharp_at_box(core, point, off);
    case CoreKind::disks:
      return is_sharp_at_disks(core, point, off);
    case CoreKind::hull:
      return is_sharp_at_hull(core, point, n, off);
    case CoreKind::ellipsoid:
    case CoreKind::other:
      break;
  }
  return false;
}

}  // namespace minkray
