// SPDX-License-Identifier: MIT
// Support points in long double from a shape's parameters. Shares no code with the shapes' own
// supports, except for superellipsoids and cut cylinders. Not for custom shapes.
#pragma once

#include <cstdlib>

#include "core/shape/shape.h"

namespace minkray::testing {

using Real3 = Vec3<long double>;

inline Real3 long_support(const Shape& shape, const Real3& n);

/// The centre c and radius r of the disk or ball that reaches furthest: n.c + r |n'| is largest.
struct LongSupport {
  using Long = long double;
  const Real3& n;

  Real3 direction() const { return n / n.norm(); }
  Real3 across() const {
    const Long length = std::hypot(n.x(), n.y());
    if (!(length > 0)) return {1, 0, 0};
    return {n.x() / length, n.y() / length, 0};
  }
  Real3 further(const Real3& a, const Real3& b) const { return n.dot(a) > n.dot(b) ? a : b; }
  Real3 rim(Long radius, Long z) const { return radius * across() + Real3(0, 0, z); }
  template <class Points>
  Real3 furthest(const Points& points) const {
    Real3 best = points[0].template cast<Long>();
    for (const auto& point : points) best = further(best, point.template cast<Long>());
    return best;
  }

  Real3 operator()(const Point& s) const { return s.position.cast<Long>(); }
  Real3 operator()(const Segment& s) const { return furthest(s.points); }
  Real3 operator()(const Triangle& s) const { return furthest(s.points); }
  Real3 operator()(const Hull& s) const { return furthest(s.points.points()); }
  Real3 operator()(const Sphere& s) const { return Long(s.radius) * direction(); }
  Real3 operator()(const Ellipsoid& s) const {
    const Real3 radii = s.radii.cast<Long>(), scaled = radii.cwiseProduct(n);
    return radii.cwiseProduct(scaled) / scaled.norm();
  }
  Real3 operator()(const Box& s) const {
    Real3 corner = s.half_extents.cast<Long>();
    for (int i = 0; i < 3; ++i) corner[i] = n[i] < 0 ? -corner[i] : corner[i];
    return corner;
  }
  Real3 operator()(const Disk& s) const { return rim(s.radius, 0); }
  Real3 operator()(const Cylinder& s) const {
    return rim(s.radius, n.z() > 0 ? s.half_height : -s.half_height);
  }
  Real3 operator()(const Cone& s) const {
    return further({0, 0, s.half_height}, rim(s.radius, -s.half_height));
  }
  Real3 operator()(const Frustum& s) const {
    return further(rim(s.radii[0], -s.half_height), rim(s.radii[1], s.half_height));
  }
  Real3 operator()(const Capsule& s) const {
    return Long(s.radius) * direction() + Real3(0, 0, n.z() > 0 ? s.half_height : -s.half_height);
  }
  Real3 operator()(const TaperedCapsule& s) const {
    return further(Long(s.radii[0]) * direction() - Real3(0, 0, s.half_height),
                   Long(s.radii[1]) * direction() + Real3(0, 0, s.half_height));
  }
  Real3 operator()(const Rounded& s) const {
    return long_support(*s.shape, n) + Long(s.radius) * direction();
  }
  Real3 operator()(const MinkowskiSum& s) const {
    Real3 sum = Real3::Zero();
    for (const Nested& part : s.shapes) sum += long_support(*part, n);
    return sum;
  }
  Real3 operator()(const HullOf& s) const {
    Real3 best = long_support(*s.shapes[0], n);
    for (const Nested& part : s.shapes) best = further(best, long_support(*part, n));
    return best;
  }
  Real3 operator()(const Transform& s) const {
    const Affine<Long> map = s.map.affine().cast<Long>();
    return map(long_support(*s.shape, map.linear.transpose() * n));
  }
  Real3 operator()(const MinkowskiDifference& s) const {
    return long_support(*s.a, n) - long_support(*s.b, -n);
  }
  Real3 operator()(const Superellipsoid& s) const { return s.support<Long>(n); }
  Real3 operator()(const CutCylinder& s) const { return s.support<Long>(n); }
  Real3 operator()(const Custom&) const { std::abort(); }
};

/// The point of the shape furthest along n, of any length but zero.
inline Real3 long_support(const Shape& shape, const Real3& n) {
  return std::visit(LongSupport{n}, shape.kind);
}

}  // namespace minkray::testing
