// SPDX-License-Identifier: MIT
#include "tests/support/measured_shapes.h"

#include "tests/support/random.h"

namespace minkray::testing {

std::vector<MeasuredShape> measured_shapes() {
  using S = Shape<double>;
  const auto hull = [](int points) -> S {
    Random random(16);
    std::vector<Vec3<double>> cloud;
    for (int i = 0; i < points; ++i) cloud.push_back(random.direction());
    return Hull<double>{PointCloud<double>(cloud)};
  };
  const S box = Box<double>{{1, 0.7, 0.5}}, egg = Ellipsoid<double>{{1, 0.5, 0.25}};
  return {
      {"sphere", Sphere<double>{1}},
      {"ellipsoid", egg},
      {"ellipsoid 1:.03:.001", Ellipsoid<double>{{1, 0.03, 0.001}}},
      {"capsule", Capsule<double>{1, 1}},
      {"cylinder", Cylinder<double>{1, 1}},
      {"cone", Cone<double>{1, 1}},
      {"frustum", Frustum<double>{{1, 0.3}, 1}},
      {"tapered_capsule", TaperedCapsule<double>{{1, 0.3}, 1}},
      {"rounded_box", Rounded<double>{0.2, box}},
      {"rounded_hull-16", Rounded<double>{0.1, hull(16)}},
      {"rounded_hull-256", Rounded<double>{0.1, hull(256)}},
      {"box", box},
      {"hull-16", hull(16)},
      {"hull-64", hull(64)},
      {"hull-256", hull(256)},
      {"ellipsoid+box", MinkowskiSum<double>{{egg, box}}},
      {"ellipsoid+ellipsoid", MinkowskiSum<double>{{egg, S(Ellipsoid<double>{{0.3, 0.5, 1}})}}},
      {"superellipsoid", Superellipsoid<double>{{1, 1, 1}, 4}},
  };
}

Shape<double> scaled(const Shape<double>& shape, double scale) {
  const Mat3<double> linear = Mat3<double>::Identity() * scale;
  return Transform<double>{shape, AffineMap<double>(Affine<double>{linear, {0, 0, 0}})};
}

}  // namespace minkray::testing
