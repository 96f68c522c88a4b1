// SPDX-License-Identifier: MIT
// A shape as queries on pairs of shapes see it: a core of one of few kinds about its own middle,
// grown by a radius, in plain numbers that a solver reads without looking anything up. A sphere is
// a point and a radius, a capsule a segment and a radius, a cylinder, cone or disk the hull of two
// disks. The distance of grown shapes is their cores' less the radii, so solvers see cores only.
#pragma once

#include <memory>
#include <vector>

#include "core/shape/shape.h"

namespace minkray {

enum class CoreKind : unsigned char {
  point,
  segment,    ///< from -z to +z
  box,        ///< around the origin
  hull,       ///< of points
  disks,      ///< the hull of two disks around the z axis
  ellipsoid,  ///< around the origin
  other,      ///< known by its support mapping only
};

struct ShapeCore {
  CoreKind kind = CoreKind::point;
  bool is_round = false;  ///< `other`, and of revolution about the z axis
  int count = 0;          ///< of a hull's points, filled up to a multiple of 8
  /// A box' half extents, an ellipsoid's radii; of disks the radii below and above; of those and of
  /// segments, z is the half height.
  Vec3<double> size = Vec3<double>::Zero();
  double radius = 0;          ///< by which the core is grown
  double rounding = 0;        ///< the core may be off by so much: what its place has cost
  double ball = 0;            ///< the radius of a ball around the middle that holds the core
  const double* x = nullptr;  ///< a hull's points, coordinate by coordinate
  const double* y = nullptr;
  const double* z = nullptr;
  const Shape* shape = nullptr;  ///< of `other`
};

/// Immutable and shared: copies are cheap.
struct CoreAndRadius {
  ShapeCore core;
  /// Rotation from the core's frame to the shape's; keeps lengths, since the core has the scales.
  Mat3<double> turn = Mat3<double>::Identity();
  Vec3<double> middle = Vec3<double>::Zero();
  Vec3<double> middle_low = Vec3<double>::Zero();  ///< rounding error of `middle`
  std::shared_ptr<const void> storage;             ///< of what the core points to
};

/// Affine maps that keep angles, and radii, are taken off, also points and balls that are added to
/// a shape; what is under any other map is `other`, but points, balls, boxes and ellipsoids along
/// the axes of a scale, and hulls.
CoreAndRadius core_and_radius(const Shape& shape, const Affine<double>& map = {});

}  // namespace minkray
