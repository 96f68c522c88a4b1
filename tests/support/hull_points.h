// SPDX-License-Identifier: MIT
// Hulls of few points that tests of polytopes have in common, and rays along their edges.
#pragma once

#include <string>
#include <vector>

#include "core/math/ray.h"
#include "tests/support/random.h"

namespace minkray::testing {

using Points = std::vector<Vec3<double>>;

inline Points on_a_sphere(int count, const Vec3<double>& extents) {
  Random random(16);
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(random.direction().cwiseProduct(extents));
  return points;
}

/// Both ends are polygons of `sides` corners, each in one plane.
inline Points prism(int sides, double half_height) {
  Points points;
  for (int i = 0; i < sides; ++i)
    for (const double z : {-half_height, half_height})
      points.push_back(
          {std::cos(6.283185307179586 * i / sides), std::sin(6.283185307179586 * i / sides), z});
  return points;
}

inline Points cube(const Mat3<double>& turned = Mat3<double>::Identity()) {
  Points points;
  for (int i = 0; i < 8; ++i)
    points.push_back(turned * Vec3<double>(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  return points;
}

struct NamedPoints {
  std::string name;
  Points points;
};

inline std::vector<NamedPoints> hulls() {
  const Mat3<double> turned =
      Eigen::AngleAxis<double>(0.7, Vec3<double>(1, 2, 3).normalized()).toRotationMatrix();
  const auto moved = [](Points points, const Vec3<double>& by) {
    for (Vec3<double>& p : points) p += by;
    return points;
  };
  return {
      {"tetrahedron", {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}},
      {"octahedron", {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}},
      {"cube", cube()},
      {"turned cube", cube(turned)},
      {"prism", prism(12, 0.5)},
      {"8 points", on_a_sphere(8, {1, 1, 1})},
      {"16 points", on_a_sphere(16, {1, 1, 1})},
      {"64 points", on_a_sphere(64, {1, 1, 1})},
      {"cigar", on_a_sphere(32, {1, 0.05, 0.03})},
      {"coin", on_a_sphere(32, {1, 1, 0.02})},
      {"beside its origin", moved(on_a_sphere(16, {1, 1, 1}), {3, -2, 0.5})},
      {"far from its origin", moved(on_a_sphere(16, {1, 1, 1}), {3000, -2, 700})},
  };
}

/// Rays along edges, through vertices, in the planes of facets; as a ray of T can.
class PointRays {
 public:
  PointRays(Points points, double R) : points_(std::move(points)), R_(R), random_(5) {}
  Ray<double> next() {
    const Vec3<double> a = any(), b = any(), c = any();
    const Vec3<double> target = random_.below(2) ? a : Vec3<double>((a + b) / 2);
    Vec3<double> along = random_.below(2) ? Vec3<double>(b - a) : Vec3<double>(c - target);
    if (random_.below(3) == 0 || !(along.norm() > 1e-3 * R_)) along = R_ * random_.direction();
    return {target - 3 * along, along};
  }

 private:
  Vec3<double> any() {
    return points_[static_cast<std::size_t>(random_.below(static_cast<int>(points_.size())))];
  }
  Points points_;
  double R_;
  Random random_;
};

}  // namespace minkray::testing
