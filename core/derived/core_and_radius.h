// SPDX-License-Identifier: MIT
// Represents a shape, for queries on pairs, as a core grown by a radius. The core is of one of a
// few kinds, around a centre called the middle. A sphere is a point and a radius; a capsule is a
// segment and a radius; the core of a cylinder, cone or disk is the hull of two disks. Two shapes
// are as far apart as their cores, minus the radii, so solvers handle only cores.
#pragma once

#include <memory>
#include <vector>

#include "core/shape/shape.h"
#include "core/support/composed_map.h"

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
  bool is_round = false;  ///< kind `other`, and a body of revolution about the z axis
  /// Number of a hull's points, filled up to a multiple of 8 by copies of a point.
  int count = 0;
  /// Half extents of a box; radii of an ellipsoid; for disks, x and y are the radii of the lower
  /// and the upper disk. For disks and segments, z is the half height.
  Vec3<double> size = Vec3<double>::Zero();
  double radius = 0;          ///< radius by which the core is grown
  double rounding = 0;        ///< error bound of the core's position due to rounding
  double ball = 0;            ///< radius of a ball around the middle that contains the core
  const double* x = nullptr;  ///< a hull's points, coordinate by coordinate
  const double* y = nullptr;
  const double* z = nullptr;
  const Shape* shape = nullptr;  ///< shape of the kind `other`
};

/// Immutable and shared: copies are cheap.
struct CoreAndRadius {
  ShapeCore core;
  /// Rotation from the core's frame to the shape's. Keeps lengths: the core's sizes include any
  /// scale.
  Mat3<double> turn = Mat3<double>::Identity();
  Vec3<double> middle = Vec3<double>::Zero();      ///< origin of the core's frame
  Vec3<double> middle_low = Vec3<double>::Zero();  ///< trailing digits of `middle`
  std::shared_ptr<const void> storage;             ///< owns the data that the core points to
};

/// Splits a shape under a map into core and radius. Rounding radii, affine maps that keep angles,
/// and Minkowski sums with points and balls become part of the radius or the pose. Maps that change
/// angles give a core of the kind `other`, except for points, balls and hulls, and for boxes and
/// ellipsoids that are scaled along their axes.
CoreAndRadius core_and_radius(const Shape& shape, const ComposedMap& map);
CoreAndRadius core_and_radius(const Shape& shape, const Affine<double>& map = {});

}  // namespace minkray
