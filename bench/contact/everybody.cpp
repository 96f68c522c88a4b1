// SPDX-License-Identifier: MIT
#include "bench/contact/everybody.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include <random>
#include <sstream>

#include "core/geometry/convex_hull.h"
#include "core/pair_distance/signed_distance.h"

namespace minkray::bench {
namespace {

/// Data that ODE refers to and does not copy.
struct Planes {
  std::vector<double> planes, points;
  std::vector<unsigned> polygons;
};

std::shared_ptr<btConvexHullShape> bullet_hull(const std::vector<Vec3<double>>& points) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (const Vec3<double>& p : points) {
    const Vec3<float> q = p.cast<float>();
    hull->addPoint({q.x(), q.y(), q.z()}, &p == &points.back());
  }
  hull->setMargin(0);
  return hull;
}

template <class B, class... Sizes>
std::shared_ptr<btConvexShape> without_margin(Sizes... sizes) {
  auto shape = std::make_shared<B>(sizes...);
  shape->setMargin(0);
  return shape;
}

Everybody hull(int count, std::mt19937& engine) {
  std::normal_distribution<double> normal;
  std::vector<Vec3<double>> points;
  for (int i = 0; i < count; ++i)
    points.push_back(Vec3<double>(normal(engine), normal(engine), normal(engine)).normalized());
  const ConvexHull found = convex_hull(points);
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>(points.begin(), points.end());
  auto faces = std::make_shared<std::vector<int>>();
  auto of_ode = std::make_shared<Planes>();
  std::ostringstream mesh;
  mesh.precision(17);
  for (const Vec3<double>& p : points) {
    of_ode->points.insert(of_ode->points.end(), {p.x(), p.y(), p.z()});
    mesh << p.x() << ' ' << p.y() << ' ' << p.z() << ' ';
  }
  for (std::size_t i = 0; i < found.facets.size(); ++i) {
    const auto corners = found.facets[i];
    const auto point = [&](std::size_t k) { return points[found.vertices[corners[k]]]; };
    const Vec3<double> n = (point(1) - point(0)).cross(point(2) - point(0)).normalized();
    of_ode->planes.insert(of_ode->planes.end(), {n.x(), n.y(), n.z(), n.dot(point(0))});
    of_ode->polygons.push_back(static_cast<unsigned>(corners.size()));
    faces->push_back(static_cast<int>(corners.size()));
    for (const std::uint32_t corner : corners) {
      of_ode->polygons.push_back(found.vertices[corner]);
      faces->push_back(static_cast<int>(found.vertices[corner]));
    }
  }
  const Shape ours = Hull{PointCloud(points)};
  const auto bullet = bullet_hull(points);
  return {"hull " + std::to_string(count),
          ours,
          ContactShape(ours),
          bullet,
          bullet,
          std::make_shared<fcl::Convexd>(vertices, static_cast<int>(found.facets.size()), faces),
          [of_ode, count] {
            return dCreateConvex(
                nullptr, of_ode->planes.data(), static_cast<unsigned>(of_ode->planes.size() / 4),
                of_ode->points.data(), static_cast<unsigned>(count), of_ode->polygons.data());
          },
          "type=\"mesh\" mesh=\"MESH\"",
          mesh.str()};
}

/// Corners of a box.
std::vector<Vec3<double>> corners_of(const Vec3<double>& half) {
  std::vector<Vec3<double>> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(half.cwiseProduct(
        Vec3<double>((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1)));
  return corners;
}

}  // namespace

std::vector<Everybody> everybody() {
  const auto made = [](std::string name, Shape ours, std::shared_ptr<btConvexShape> bullet,
                       std::shared_ptr<fcl::CollisionGeometryd> of_fcl,
                       std::function<dGeomID()> ode, std::string mujoco) {
    return Everybody{std::move(name), ours,   ContactShape(ours), bullet,
                     bullet,          of_fcl, std::move(ode),     std::move(mujoco)};
  };
  std::mt19937 engine(7);
  std::vector<Everybody> all = {
      made(
          "sphere", Sphere{0.5}, std::make_shared<btSphereShape>(0.5f),
          std::make_shared<fcl::Sphered>(0.5), [] { return dCreateSphere(nullptr, 0.5); },
          "type=\"sphere\" size=\"0.5\""),
      made(
          "capsule", Capsule{0.25, 0.75}, std::make_shared<btCapsuleShapeZ>(0.25f, 1.5f),
          std::make_shared<fcl::Capsuled>(0.25, 1.5),
          [] { return dCreateCapsule(nullptr, 0.25, 1.5); }, "type=\"capsule\" size=\"0.25 0.75\""),
      made(
          "box", Box{{1, 0.5, 0.25}}, without_margin<btBoxShape>(btVector3(1, 0.5f, 0.25f)),
          std::make_shared<fcl::Boxd>(2, 1, 0.5), [] { return dCreateBox(nullptr, 2, 1, 0.5); },
          "type=\"box\" size=\"1 0.5 0.25\""),
      made(
          "cylinder", Cylinder{0.5, 0.75},
          without_margin<btCylinderShapeZ>(btVector3(0.5f, 0.5f, 0.75f)),
          std::make_shared<fcl::Cylinderd>(0.5, 1.5),
          [] { return dCreateCylinder(nullptr, 0.5, 1.5); }, "type=\"cylinder\" size=\"0.5 0.75\""),
      made("cone", Cone{0.5, 0.75}, without_margin<btConeShapeZ>(0.5f, 1.5f),
           std::make_shared<fcl::Coned>(0.5, 1.5), nullptr, ""),
      made("ellipsoid", Ellipsoid{{1, 0.6, 0.3}}, nullptr,
           std::make_shared<fcl::Ellipsoidd>(1, 0.6, 0.3), nullptr,
           "type=\"ellipsoid\" size=\"1 0.6 0.3\""),
      hull(32, engine),
      hull(64, engine),
  };
  // A box' margin is taken from its half extents; distances round it off.
  const Vec3<double> half(0.8, 0.4, 0.2);
  const Shape core = Box{half};
  Everybody rounded =
      made("rounded box", Rounded{0.1, Nested(core)}, nullptr, nullptr, nullptr, "");
  const auto margin = std::make_shared<btBoxShape>(btVector3(0.9f, 0.5f, 0.3f));
  margin->setMargin(0.1f);
  rounded.bullet = margin;
  const auto grown = bullet_hull(corners_of(half));
  grown->setMargin(0.1f);
  rounded.bullet_for_casts = grown;
  all.push_back(rounded);
  return all;
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

std::vector<Placement> placements(const Everybody& a, const Everybody& b, std::size_t count) {
  std::mt19937 engine(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto direction = [&] {
    return Vec3<double>(normal(engine), normal(engine), normal(engine)).normalized();
  };
  const auto turn = [&] {
    return rotation_matrix(normal(engine), normal(engine), normal(engine), normal(engine));
  };
  constexpr double near = 1e-6;
  const double size = a.ready.ball_radius() + b.ready.ball_radius();
  std::vector<Placement> all;
  while (all.size() < count) {
    const std::size_t k = all.size() % 10;
    const bool overlaps = k >= 7, touches = k == 5 || k == 6;
    const double far = overlaps ? 0.6 * uniform(engine) : 0.6 + 1.4 * uniform(engine);
    const Vec3<double> where = far * size * direction();
    Placement placed{{turn(), Vec3<double>::Zero()},
                     {turn(), where},
                     Vec3<double>(-2 * where + 0.7 * direction())};
    const SignedDistance found = signed_distance(a.ready, placed.a, b.ready, placed.b);
    if (overlaps ? found.upper >= 0 : found.lower < 1e-3) continue;
    if (touches)
      placed.b.translation -= (found.value - near * (2 * uniform(engine) - 1)) * found.normal;
    all.push_back(placed);
  }
  return all;
}

}  // namespace minkray::bench
