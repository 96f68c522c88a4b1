// SPDX-License-Identifier: MIT
// Shapes, nestings, poses and rays from bytes.
#pragma once

#include "core/derived/shape_bounds.h"
#include "core/math/ray.h"
#include "core/shape/shape.h"
#include "tests/fuzz/bytes.h"

namespace minkray::fuzz {

/// An invertible map whose condition number is below a few hundred: turned, scaled by up to 8 along
/// each axis or mirrored, moved, and in wild input scaled by any power of two as a whole.
inline Affine<double> map_from(Bytes& bytes, bool wild) {
  using Quaternion = Eigen::Quaternion<double>;
  const auto part = [&] { return bytes.below(4) == 0 ? 0.0 : 2 * bytes.fraction() - 1; };
  const double x = part(), y = part(), z = part(), w = part();
  const Quaternion q(w, x, y, z);
  const Mat3<double> turn =
      q.norm() > 0.1 ? q.normalized().toRotationMatrix() : Mat3<double>(Mat3<double>::Identity());
  Vec3<double> scale;
  for (double& s : scale) {
    const double sign = bytes.byte() & 1 ? -1 : 1;
    s = std::ldexp(sign, bytes.below(7) - 3);
  }
  if (wild && bytes.below(3) == 0) scale *= std::ldexp(1, bytes.below(120) - 60);
  const bool moves = bytes.below(2) == 1;
  const Vec3<double> by = moves ? bytes.point<double>(wild) : Vec3<double>(Vec3<double>::Zero());
  return {Mat3<double>(turn * scale.asDiagonal()), by};
}

inline Shape leaf_from(Bytes& bytes, bool wild) {
  const auto point = [&] { return bytes.point<double>(wild); };
  const auto positive = [&] { return bytes.positive<double>(wild); };
  const auto length = [&] { return bytes.length<double>(wild); };
  const auto radii = [&] {
    const double x = positive(), y = positive(), z = positive();
    return Vec3<double>(x, y, z);
  };
  const auto pair = [&] {
    const double lower = length(), upper = length();
    return std::array<double, 2>{lower, upper};
  };
  switch (bytes.below(15)) {
    case 0:
      return Point{point()};
    case 1: {
      const Vec3<double> a = point(), b = point();
      return Segment{{a, b}};
    }
    case 2: {
      const Vec3<double> a = point(), b = point(), c = point();
      return Triangle{{a, b, c}};
    }
    case 3:
      return Sphere{positive()};
    case 4:
      return Ellipsoid{radii()};
    case 5: {
      const double x = length(), y = length(), z = length();
      return Box{{x, y, z}};
    }
    case 6:
      return Disk{positive()};
    case 7: {
      const double radius = positive(), half_height = length();
      return Cylinder{radius, half_height};
    }
    case 8: {
      const double radius = positive(), half_height = length();
      return Cone{radius, half_height};
    }
    case 9: {
      const double radius = positive(), half_height = length();
      return Capsule{radius, half_height};
    }
    case 10: {
      const auto ends = pair();
      return TaperedCapsule{ends, length()};
    }
    case 11: {
      const auto ends = pair();
      return Frustum{ends, length()};
    }
    case 12: {
      const Vec3<double> of = radii();
      const double exponent =
          bytes.below(4) == 0 ? double(1 + bytes.below(3)) : double(1 + 12 * bytes.fraction());
      return Superellipsoid{of, exponent};
    }
    case 13: {
      std::vector<Vec3<double>> points;
      for (int left = bytes.below(12); left >= 0; --left) points.push_back(point());
      return Hull{PointCloud(std::move(points))};
    }
    default: {
      // Many points, most of them vertices: on an ellipsoid, or on a coarse lattice, with ties.
      std::vector<Vec3<double>> points;
      const Vec3<double> of = radii();
      const bool lattice = bytes.below(2) == 1;
      const int count = 12 + bytes.below(80);
      std::uint32_t state = bytes.byte() + 1;
      const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 16; };
      for (int i = 0; i < count; ++i) {
        Vec3<double> p;
        for (double& x : p) x = lattice ? double(next() % 3) - 1 : next() * 0x1p-15 - 1;
        if (!lattice && p.norm() > 0.1) p.normalize();
        points.push_back(p.cwiseProduct(of));
      }
      return Hull{PointCloud(std::move(points))};
    }
  }
}

inline Shape shape_from(Bytes& bytes, bool wild, int depth = 3) {
  if (depth == 0) return leaf_from(bytes, wild);
  const int kind = bytes.below(12);
  const auto nested = [&] { return shape_from(bytes, wild, depth - 1); };
  const auto list = [&] {
    ShapeList shapes;
    for (int left = bytes.below(3); left >= 0; --left) shapes.push_back(nested());
    return shapes;
  };
  const auto point_part = [&] { return bytes.point<double>(wild).z(); };
  const auto slope = [&] { return double(4 * bytes.fraction() - 2); };
  switch (kind) {
    case 0: {
      const double radius = bytes.length<double>(wild);
      return Rounded{radius, nested()};
    }
    case 1:
      return MinkowskiSum{list()};
    case 2: {
      Nested a = nested(), b = nested();
      return MinkowskiDifference{a, b};
    }
    case 3:
      return HullOf{list()};
    case 4:
    case 5: {
      const Affine<double> map = map_from(bytes, wild);
      return Transform{nested(), AffineMap(map)};
    }
    case 6: {
      const double radius = bytes.positive<double>(wild), lowest = point_part(),
                   height = bytes.length<double>(wild);
      const double x = slope(), y = slope();
      // Parallel planes, or such that touch or leave room at the rim.
      const double turn = bytes.below(2) == 0 ? 0.0 : height / (2.0 * radius);
      return CutCylinder{radius, {lowest, lowest + height}, {x, y}, {x + turn, y}};
    }
    default:
      return leaf_from(bytes, wild);
  }
}

/// Rays that have to do with the shape: they begin far away, at its surface, within it, and go past
/// it, along it, through its extreme points, or nowhere.
inline Ray<double> ray_from(Bytes& bytes, const Shape& shape, bool wild) {
  const Bounds<double> bounds = bounds_of(shape);
  const Vec3<double> centre = bounds.centre(), size = bounds.half_extents();
  const auto direction = [&] {
    Vec3<double> n;
    for (double& x : n)
      x = bytes.below(3) == 0 ? double(bytes.below(3) - 1) : double(2 * bytes.fraction() - 1);
    return n;
  };
  const auto place = [&]() -> Vec3<double> {
    switch (bytes.below(6)) {
      case 0:
        return shape.support(direction());
      case 1:
        return centre;
      case 2:
        return 0.5 * centre + 0.5 * shape.support(direction());
      case 3:
        return bytes.point<double>(wild);
      default:
        return centre + 2.0 * size.cwiseProduct(direction());
    }
  };
  Ray<double> ray{place(), Vec3<double>::Zero()};
  switch (bytes.below(8)) {
    case 0:
      ray.direction = direction();
      break;
    case 1:
      ray.direction = bytes.point<double>(wild);
      break;
    default:
      ray.direction = place() - ray.origin;
      break;
  }
  const int back = bytes.below(6);
  if (back < 3) ray.origin -= ray.direction * double(1 + back);
  if (back == 3 && wild) ray.origin -= ray.direction * double(std::ldexp(1, bytes.below(60)));
  const int end = bytes.below(6);
  if (end == 0) ray.t_max = double(bytes.below(4));
  if (end == 1) ray.t_max = bytes.length<double>(wild);
  return ray;
}

}  // namespace minkray::fuzz
