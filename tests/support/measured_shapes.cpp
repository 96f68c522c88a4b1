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

std::vector<MeasuredShape> derived_shapes() {
  using S = Shape;
  const auto moved = [](const S& shape, double z) -> S {
    return Transform{shape, AffineMap(Affine<double>{Mat3<double>::Identity(), {0, 0, z}})};
  };
  const auto turned = [](const S& shape) -> S {  // by a quarter turn around z
    Mat3<double> turn;
    turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    return Transform{shape, AffineMap(Affine<double>{turn, {0, 0, 0}})};
  };
  const S box = Box{{1, 0.7, 0.5}}, egg = Ellipsoid{{1, 0.5, 0.25}}, cylinder = Cylinder{1, 1},
          cone = Cone{1, 1}, disk = Disk{1}, ball = Sphere{0.5}, capsule = Capsule{1, 1},
          frustum = Frustum{{1, 0.3}, 1}, needle = TaperedCapsule{{1, 0.3}, 1},
          rod = Segment{{Vec3<double>(0, 0, -1), Vec3<double>(0, 0, 1)}};
  return {
      {"rounded_cylinder", Rounded{0.5, cylinder}},
      {"rounded_cone", Rounded{0.5, cone}},
      {"rounded_disk", Rounded{0.5, disk}},
      {"disk", disk},
      {"cylinder-cylinder", MinkowskiDifference{cylinder, cylinder}, Cylinder{2, 2}},
      {"turned cylinders", MinkowskiSum{{cylinder, turned(cylinder)}}, Cylinder{2, 2}},
      {"3 cylinders", MinkowskiSum{{cylinder, cylinder, cylinder}}, Cylinder{3, 3}},
      {"cone+cone", MinkowskiSum{{cone, turned(cone)}}, scaled(cone, 2)},
      {"frustum+frustum", MinkowskiSum{{frustum, turned(frustum)}}, Frustum{{2, 0.6}, 2}},
      {"sphere+cylinder", MinkowskiSum{{ball, cylinder}}, Rounded{0.5, cylinder}},
      {"cylinder-sphere", MinkowskiDifference{cylinder, ball}, Rounded{0.5, cylinder}},
      {"disk+disk", MinkowskiSum{{disk, disk}}, Disk{2}},
      {"disk+segment", MinkowskiSum{{disk, rod}}, cylinder},
      {"capsule-capsule", MinkowskiDifference{capsule, capsule}, Capsule{2, 2}},
      {"tapered_capsules", MinkowskiSum{{needle, needle}}, TaperedCapsule{{2, 0.6}, 2}},
      {"ellipsoid-ellipsoid", MinkowskiDifference{egg, egg}, Ellipsoid{{2, 1, 0.5}}},
      {"box-box", MinkowskiDifference{box, box}, Box{{2, 1.4, 1}}},
      {"hull of disks", HullOf{{moved(disk, 1), moved(disk, -1)}}, cylinder},
      {"hull of disk, point", HullOf{{moved(disk, -1), S(Point{{0, 0, 1}})}}, cone},
      {"hull of spheres", HullOf{{moved(S(Sphere{1}), 1), moved(S(Sphere{1}), -1)}}, capsule},
  };
}

Shape scaled(const Shape& shape, double scale) {
  const Mat3<double> linear = Mat3<double>::Identity() * scale;
  return Transform{shape, AffineMap(Affine<double>{linear, {0, 0, 0}})};
}

}  // namespace minkray::testing
