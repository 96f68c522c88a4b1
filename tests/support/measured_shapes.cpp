// SPDX-License-Identifier: MIT
#include "tests/support/measured_shapes.h"

#include "tests/support/random.h"

namespace minkray::testing {

std::vector<MeasuredShape> measured_shapes() {
  using S = Shape;
  const auto hull = [](int points) -> S {
    Random random(16);
    std::vector<Vec3<double>> cloud;
    for (int i = 0; i < points; ++i) cloud.push_back(random.direction());
    return Hull{PointCloud(cloud)};
  };
  const S box = Box{{1, 0.7, 0.5}}, egg = Ellipsoid{{1, 0.5, 0.25}};
  return {
      {"sphere", Sphere{1}},
      {"ellipsoid", egg},
      {"ellipsoid 1:.03:.001", Ellipsoid{{1, 0.03, 0.001}}},
      {"capsule", Capsule{1, 1}},
      {"cylinder", Cylinder{1, 1}},
      {"cone", Cone{1, 1}},
      {"frustum", Frustum{{1, 0.3}, 1}},
      {"tapered_capsule", TaperedCapsule{{1, 0.3}, 1}},
      {"rounded_box", Rounded{0.2, box}},
      {"rounded_hull-16", Rounded{0.1, hull(16)}},
      {"rounded_hull-256", Rounded{0.1, hull(256)}},
      {"box", box},
      {"hull-16", hull(16)},
      {"hull-64", hull(64)},
      {"hull-256", hull(256)},
      {"ellipsoid+box", MinkowskiSum{{egg, box}}},
      {"ellipsoid+ellipsoid", MinkowskiSum{{egg, S(Ellipsoid{{0.3, 0.5, 1}})}}},
      {"superellipsoid", Superellipsoid{{1, 1, 1}, 4}},
  };
}

Shape scaled(const Shape& shape, double scale) {
  const Mat3<double> linear = Mat3<double>::Identity() * scale;
  return Transform{shape, AffineMap(Affine<double>{linear, {0, 0, 0}})};
}

}  // namespace minkray::testing
