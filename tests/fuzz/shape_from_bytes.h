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
template <class T>
Affine<T> map_from(Bytes& bytes, bool wild) {
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
  const Vec3<T> by = moves ? bytes.point<T>(wild) : Vec3<T>(Vec3<T>::Zero());
  return {Mat3<double>(turn * scale.asDiagonal()).cast<T>(), by};
}

template <class T>
Shape<T> leaf_from(Bytes& bytes, bool wild) {
  const auto point = [&] { return bytes.point<T>(wild); };
  const auto positive = [&] { return bytes.positive<T>(wild); };
  const auto length = [&] { return bytes.length<T>(wild); };
  const auto radii = [&] {
    const T x = positive(), y = positive(), z = positive();
    return Vec3<T>(x, y, z);
  };
  const auto pair = [&] {
    const T lower = length(), upper = length();
    return std::array<T, 2>{lower, upper};
  };
  switch (bytes.below(15)) {
    case 0:
      return Point<T>{point()};
    case 1: {
      const Vec3<T> a = point(), b = point();
      return Segment<T>{{a, b}};
    }
    case 2: {
      const Vec3<T> a = point(), b = point(), c = point();
      return Triangle<T>{{a, b, c}};
    }
    case 3:
      return Sphere<T>{positive()};
    case 4:
      return Ellipsoid<T>{radii()};
    case 5: {
      const T x = length(), y = length(), z = length();
      return Box<T>{{x, y, z}};
    }
    case 6:
      return Disk<T>{positive()};
    case 7: {
      const T radius = positive(), half_height = length();
      return Cylinder<T>{radius, half_height};
    }
    case 8: {
      const T radius = positive(), half_height = length();
      return Cone<T>{radius, half_height};
    }
    case 9: {
      const T radius = positive(), half_height = length();
      return Capsule<T>{radius, half_height};
    }
    case 10: {
      const auto ends = pair();
      return TaperedCapsule<T>{ends, length()};
    }
    case 11: {
      const auto ends = pair();
      return Frustum<T>{ends, length()};
    }
    case 12: {
      const Vec3<T> of = radii();
      const T exponent = bytes.below(4) == 0 ? T(1 + bytes.below(3)) : T(1 + 12 * bytes.fraction());
      return Superellipsoid<T>{of, exponent};
    }
    case 13: {
      std::vector<Vec3<T>> points;
      for (int left = bytes.below(12); left >= 0; --left) points.push_back(point());
      return Hull<T>{PointCloud<T>(std::move(points))};
    }
    default: {
      // Many points, most of them vertices: on an ellipsoid, or on a coarse lattice, with ties.
      std::vector<Vec3<T>> points;
      const Vec3<T> of = radii();
      const bool lattice = bytes.below(2) == 1;
      const int count = 12 + bytes.below(80);
      std::uint32_t state = bytes.byte() + 1;
      const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 16; };
      for (int i = 0; i < count; ++i) {
        Vec3<double> p;
        for (double& x : p) x = lattice ? double(next() % 3) - 1 : next() * 0x1p-15 - 1;
        if (!lattice && p.norm() > 0.1) p.normalize();
        points.push_back(p.cast<T>().cwiseProduct(of));
      }
      return Hull<T>{PointCloud<T>(std::move(points))};
    }
  }
}

template <class T>
Shape<T> shape_from(Bytes& bytes, bool wild, int depth = 3) {
  if (depth == 0) return leaf_from<T>(bytes, wild);
  const int kind = bytes.below(12);
  const auto nested = [&] { return shape_from<T>(bytes, wild, depth - 1); };
  const auto list = [&] {
    ShapeList<T> shapes;
    for (int left = bytes.below(3); left >= 0; --left) shapes.push_back(nested());
    return shapes;
  };
  const auto point_part = [&] { return bytes.point<T>(wild).z(); };
  const auto slope = [&] { return T(4 * bytes.fraction() - 2); };
  switch (kind) {
    case 0: {
      const T radius = bytes.length<T>(wild);
      return Rounded<T>{radius, nested()};
    }
    case 1:
      return MinkowskiSum<T>{list()};
    case 2: {
      Nested<T> a = nested(), b = nested();
      return MinkowskiDifference<T>{a, b};
    }
    case 3:
      return HullOf<T>{list()};
    case 4:
    case 5: {
      const Affine<T> map = map_from<T>(bytes, wild);
      return Transform<T>{nested(), AffineMap<T>(map)};
    }
    case 6: {
      const T radius = bytes.positive<T>(wild), lowest = point_part(),
              height = bytes.length<T>(wild);
      const T x = slope(), y = slope();
      // Parallel planes, or such that touch or leave room at the rim.
      const T turn = bytes.below(2) == 0 ? T(0) : height / (T(2) * radius);
      return CutCylinder<T>{radius, {lowest, lowest + height}, {x, y}, {x + turn, y}};
    }
    default:
      return leaf_from<T>(bytes, wild);
  }
}

/// Rays that have to do with the shape: they begin far away, at its surface, within it, and go past
/// it, along it, through its extreme points, or nowhere.
template <class T>
Ray<T> ray_from(Bytes& bytes, const Shape<T>& shape, bool wild) {
  const Bounds<T> bounds = bounds_of<T>(shape);
  const Vec3<T> centre = bounds.centre(), size = bounds.half_extents();
  const auto direction = [&] {
    Vec3<T> n;
    for (T& x : n) x = bytes.below(3) == 0 ? T(bytes.below(3) - 1) : T(2 * bytes.fraction() - 1);
    return n;
  };
  const auto place = [&]() -> Vec3<T> {
    switch (bytes.below(6)) {
      case 0:
        return shape.support(direction());
      case 1:
        return centre;
      case 2:
        return T(0.5) * centre + T(0.5) * shape.support(direction());
      case 3:
        return bytes.point<T>(wild);
      default:
        return centre + T(2) * size.cwiseProduct(direction());
    }
  };
  Ray<T> ray{place(), Vec3<T>::Zero()};
  switch (bytes.below(8)) {
    case 0:
      ray.direction = direction();
      break;
    case 1:
      ray.direction = bytes.point<T>(wild);
      break;
    default:
      ray.direction = place() - ray.origin;
      break;
  }
  const int back = bytes.below(6);
  if (back < 3) ray.origin -= ray.direction * T(1 + back);
  if (back == 3 && wild) ray.origin -= ray.direction * T(std::ldexp(1, bytes.below(60)));
  const int end = bytes.below(6);
  if (end == 0) ray.t_max = T(bytes.below(4));
  if (end == 1) ray.t_max = bytes.length<T>(wild);
  return ray;
}

}  // namespace minkray::fuzz
