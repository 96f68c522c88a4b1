// SPDX-License-Identifier: MIT
#include "core/pair/flat_part.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/math/length.h"

namespace minkray {
namespace {

FlatPart of_box(const ShapeCore& core, const Vec3<double>& d, double tilt) {
  FlatPart part;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(d[i]) > tilt || !(core.size[i] > 0)) continue;
    ++part.dimension;
    part.along = Vec3<double>::Unit(i);
    part.length = 2 * core.size[i];
  }
  part.dimension = std::min(part.dimension, 2);
  return part;
}

FlatPart of_disks(const ShapeCore& core, const Vec3<double>& d, double tilt) {
  const double across = std::sqrt(d.x() * d.x() + d.y() * d.y());
  const bool above = 2 * core.size.z() * d.z() + (core.size.y() - core.size.x()) * across > 0;
  if (across <= tilt) {
    if ((above ? core.size.y() : core.size.x()) > 0) return {2};
    return {};
  }
  // Direction of the side: the line from one rim to the other that faces d.
  const double rise = 2 * core.size.z(), widening = core.size.y() - core.size.x();
  const double length = length_of(rise, widening);
  if (!(length > 0) || std::abs(rise * d.z() + widening * across) > tilt * length) return {};
  const double k = widening / (across * length);
  return {1, {k * d.x(), k * d.y(), rise / length}, length};
}

FlatPart of_hull(const ShapeCore& core, const Vec3<double>& d, double tilt, double height) {
  const auto point = [&](int i) { return Vec3<double>(core.x[i], core.y[i], core.z[i]); };
  int first = -1;  // of the part's points
  Vec3<double> s = Vec3<double>::Zero();
  if (height == unknown_height) {
    first = furthest_of_hull(core, d.x(), d.y(), d.z());
    s = point(first);
    height = s.dot(d);
  }
  const double most = height - 2 * tilt * core.ball;
  constexpr double same = 1e-12;  // points closer than this, relative to the size, count as one
  constexpr double straight = 1e-9;
  FlatPart part;
  for (int begin = 0; begin < core.count; begin += 64) {
    std::uint64_t far = far_of_hull(core, d.x(), d.y(), d.z(), most, begin);
    for (; far != 0; far &= far - 1) {
      const int i = begin + std::countr_zero(far);
      if (first < 0) {
        first = i;
        s = point(i);
      }
      if (i == first) continue;
      const Vec3<double> to = point(i) - s;
      const double length = to.norm();
      if (length <= same * core.ball || std::abs(to.dot(d)) > tilt * length) continue;
      if (part.dimension == 0) {
        part = {1, to / length, length};
      } else if (part.along.cross(to).norm() > straight * length) {
        part.dimension = 2;
        return part;
      } else {
        part.length = std::max(part.length, length);
      }
    }
  }
  return first < 0 ? of_hull(core, d, tilt, unknown_height) : part;
}

FlatPart of_other(const ShapeCore& core, const Vec3<double>& d, double tilt) {
  constexpr double least_tilt = 1e-7;
  // On curved surfaces with radii below about 4000 sizes, the support point moves by less than
  // `flat` (relative to the size) when the direction turns by `step`.
  const double step = std::max(2 * tilt, least_tilt), flat = std::max(1e-3, 4e3 * step);
  const Vec3<double> u = d.unitOrthogonal(), v = d.cross(u);
  FlatPart part;
  for (const Vec3<double>& aside : {u, v}) {
    const Vec3<double> one = d + step * aside, other = d - step * aside;
    const Vec3<double> way = core.shape->support(one) - core.shape->support(other);
    const double length = way.norm();
    if (!(length > std::min(flat, 0.5) * core.ball)) continue;
    constexpr double straight = 1e-3;
    if (part.dimension == 0)
      part = {1, way / length, length};
    else if (part.along.cross(way).norm() > straight * length)
      part.dimension = 2;
  }
  return part;
}

}  // namespace

FlatPart flat_part(const ShapeCore& core, const Vec3<double>& d, double tilt, double height) {
  switch (core.kind) {
    case CoreKind::point:
    case CoreKind::ellipsoid:
      return {};
    case CoreKind::segment:
      if (std::abs(d.z()) > tilt || !(core.size.z() > 0)) return {};
      return {1, Vec3<double>::UnitZ(), 2 * core.size.z()};
    case CoreKind::box:
      return of_box(core, d, tilt);
    case CoreKind::hull:
      return of_hull(core, d, tilt, height);
    case CoreKind::disks:
      return of_disks(core, d, tilt);
    case CoreKind::other:
      break;
  }
  return of_other(core, d, tilt);
}

}  // namespace minkray
