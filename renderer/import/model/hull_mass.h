// SPDX-License-Identifier: MIT
// Volume, centre of mass and inertia of shapes with a density of 1. MuJoCo uses them to place
// bodies that have no position and to fit primitives to meshes.
#pragma once

#include <array>

#include "core/geometry/point_cloud.h"
#include "core/math/affine.h"
#include "core/shape/shape.h"

namespace minkray {

struct Mass {
  double volume = 0;
  Vec3<double> centre = Vec3<double>::Zero();
  Mat3<double> inertia = Mat3<double>::Zero();  ///< about the centre
};

/// Sums, for a hull, over tetrahedra of its surface's triangles (Mirtich, Fast and accurate
/// computation of polyhedral mass properties, 1996, by simplices). Flat hulls have none.
Mass mass_of(const PointCloud& hull);

/// Volume and centre of the shapes that robots' files have; no inertia. Flat shapes have none.
Mass volume_of(const Shape& shape);

/// The box of the same inertia: half its sides, the longest last, and its pose.
struct InertiaBox {
  std::array<double, 3> half_sides;
  Affine<double> pose;
};
InertiaBox inertia_box(const Mass& mass);

}  // namespace minkray
