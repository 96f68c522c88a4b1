// SPDX-License-Identifier: MIT
#include "body.h"

#include <algorithm>

#include "random.h"

namespace bench {

Mesh Body::mesh(double relative_error) const {
  return coarsest(mesh_of_steps, shape, relative_error * radius);
}

Body sphere(double radius) {
  return {"sphere", mk::sphere(radius),
          [=](int steps) { return mesh_of_rounded_box({}, radius, steps); }, radius};
}

Body ellipsoid(const Vec& radii) {
  const auto make = [=](int steps) {
    Mesh mesh = mesh_of_rounded_box({}, 1, steps);
    for (Vec& vertex : mesh.vertices) vertex = scaled(radii, vertex);
    return mesh;
  };
  return {"ellipsoid", mk::ellipsoid(radii), make, std::max({radii.x, radii.y, radii.z})};
}

Body box(const Vec& half_extents) {
  return {"box", mk::box(half_extents),
          [=](int) { return mesh_of_rounded_box(half_extents, 0, 1); }, norm(half_extents)};
}

Body rounded_box(const Vec& half_extents, double radius) {
  return {"rounded box", mk::rounded(mk::box(half_extents), radius),
          [=](int steps) { return mesh_of_rounded_box(half_extents, radius, steps); },
          norm(half_extents) + radius};
}

Body capsule(double radius, double half_height) {
  return {"capsule", mk::capsule(radius, half_height),
          [=](int steps) {
            return mesh_of_rounded_box({0, 0, half_height}, radius, steps);
          },
          half_height + radius};
}

Body cylinder(double radius, double half_height) {
  return {"cylinder", mk::cylinder(radius, half_height),
          [=](int sides) { return mesh_of_frustum(radius, radius, half_height, sides); },
          std::hypot(radius, half_height)};
}

Body cone(double radius, double half_height) {
  return {"cone", mk::cone(radius, half_height),
          [=](int sides) { return mesh_of_frustum(radius, 0, half_height, sides); },
          std::hypot(radius, half_height)};
}

Body hull(const std::vector<Vec>& points) {
  std::vector<mk::Vec3> plain(points.begin(), points.end());
  double radius = 0;
  for (const Vec& p : points) radius = std::max(radius, norm(p));
  return {"hull " + std::to_string(points.size()), mk::hull(plain),
          [=](int) { return mesh_of_hull(points); }, radius};
}

std::vector<Vec> random_points(int count, const Vec& radii, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec> points;
  for (int i = 0; i < count; ++i) points.push_back(scaled(radii, random.direction()));
  return points;
}

}  // namespace bench
