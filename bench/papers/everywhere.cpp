// SPDX-License-Identifier: MIT
#include "bench/papers/everywhere.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include <random>

namespace minkray::bench {

std::vector<Everywhere> make_shapes() {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  std::vector<Vec3<double>> points;
  auto hull = std::make_shared<btConvexHullShape>();
  for (int i = 0; i < 32; ++i) {
    points.push_back(Vec3<double>(normal(engine), normal(engine), normal(engine)).normalized());
    const auto p = points.back().cast<float>();
    hull->addPoint({p.x(), p.y(), p.z()}, i == 31);
  }
  std::vector<Everywhere> shapes = {
      {"sphere", Sphere{0.5}, std::make_shared<btSphereShape>(0.5f),
       std::make_shared<fcl::Sphered>(0.5)},
      {"box", Box{{1, 0.5, 0.25}}, std::make_shared<btBoxShape>(btVector3(1, 0.5f, 0.25f)),
       std::make_shared<fcl::Boxd>(2, 1, 0.5)},
      {"cylinder", Cylinder{0.5, 0.75},
       std::make_shared<btCylinderShapeZ>(btVector3(0.5f, 0.5f, 0.75f)),
       std::make_shared<fcl::Cylinderd>(0.5, 1.5)},
      {"cone", Cone{0.5, 0.75}, std::make_shared<btConeShapeZ>(0.5f, 1.5f),
       std::make_shared<fcl::Coned>(0.5, 1.5)},
      {"hull 32", Hull{PointCloud(points)}, hull, nullptr},
  };
  return shapes;
}

btTransform to_bullet(const Affine<double>& pose) {
  const Mat3<float> m = pose.linear.cast<float>();
  const Vec3<float> t = pose.translation.cast<float>();
  return btTransform(
      btMatrix3x3(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)),
      btVector3(t.x(), t.y(), t.z()));
}

fcl::Transform3d to_fcl(const Affine<double>& pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.linear() = pose.linear;
  result.translation() = pose.translation;
  return result;
}

}  // namespace minkray::bench
