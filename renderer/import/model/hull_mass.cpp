// SPDX-License-Identifier: MIT
#include "renderer/import/model/hull_mass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/principal_axes.h"

namespace minkray {

Mass mass_of(const PointCloud& hull) {
  Mass mass;
  const FacetMesh* facets = hull.facets();
  if (!facets) return mass;
  // Relative to a vertex, for digits.
  const Vec3<double> base = hull.points()[0];
  Vec3<double> first = Vec3<double>::Zero();
  Mat3<double> second = Mat3<double>::Zero();
  for (std::size_t i = 0; i < facets->size(); ++i) {
    const Vec3<double> a = (*facets)[i].corner(0) - base, b = (*facets)[i].corner(1) - base,
                       c = (*facets)[i].corner(2) - base;
    const double six_volumes = a.dot(b.cross(c));
    mass.volume += six_volumes / 6;
    first += six_volumes / 24 * (a + b + c);
    const Vec3<double> sum = a + b + c;
    second += six_volumes / 120 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (!(mass.volume > 0)) return {};
  const Vec3<double> centre = first / mass.volume;
  second -= mass.volume * centre * centre.transpose();
  mass.centre = base + centre;
  mass.inertia = second.trace() * Mat3<double>::Identity() - second;
  return mass;
}

Mass volume_of(const Shape& shape) {
  constexpr double pi = std::numbers::pi;
  Mass mass;
  if (const auto* sphere = std::get_if<Sphere>(&shape.kind)) {
    mass.volume = 4 * pi / 3 * sphere->radius * sphere->radius * sphere->radius;
  } else if (const auto* capsule = std::get_if<Capsule>(&shape.kind)) {
    const double r = capsule->radius;
    mass.volume = pi * r * r * (2 * capsule->half_height + 4 * r / 3);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.kind)) {
    mass.volume = 2 * pi * cylinder->radius * cylinder->radius * cylinder->half_height;
  } else if (const auto* box = std::get_if<Box>(&shape.kind)) {
    mass.volume = 8 * box->half_extents.prod();
  } else if (const auto* ellipsoid = std::get_if<Ellipsoid>(&shape.kind)) {
    mass.volume = 4 * pi / 3 * ellipsoid->radii.prod();
  } else if (const auto* hull = std::get_if<Hull>(&shape.kind)) {
    mass = mass_of(hull->points);
  }
  return mass;
}

InertiaBox inertia_box(const Mass& mass) {
  const PrincipalAxes axes = principal_axes(mass.inertia);
  // The least moment is about the longest axis.
  InertiaBox box;
  Vec3<double> moments;
  for (int i = 0; i < 3; ++i) {
    moments[i] = axes.values[2 - i];
    box.pose.linear.col(i) = axes.axes.col(2 - i);
  }
  if (box.pose.linear.determinant() < 0) box.pose.linear.col(0) *= -1;
  box.pose.translation = mass.centre;
  for (int i = 0; i < 3; ++i) {
    const double square = moments.sum() - 2 * moments[i];
    box.half_sides[static_cast<std::size_t>(i)] =
        0.5 * std::sqrt(6 * std::max(square, 0.0) / mass.volume);
  }
  return box;
}

}  // namespace minkray
