// SPDX-License-Identifier: MIT
// Bullet's casters, as its btCollisionWorld::rayTest uses them: a point cast at a convex shape,
// with their own absolute tolerances.
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <btBulletCollisionCommon.h>

#include "bench/peers/others.h"

namespace minkray::bench {
namespace {

template <class T>
btScalar scalar(T value) {
  return static_cast<btScalar>(value);
}

btVector3 vector(const Vec3<float>& v) {
  return {scalar(v.x()), scalar(v.y()), scalar(v.z())};
}

std::unique_ptr<btConvexShape> bullet_shape(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape.kind))
    return std::make_unique<btSphereShape>(scalar(sphere->radius));
  if (const auto* box = std::get_if<Box>(&shape.kind))
    return std::make_unique<btBoxShape>(vector(box->half_extents.cast<float>()));
  if (const auto* cylinder = std::get_if<Cylinder>(&shape.kind))
    return std::make_unique<btCylinderShapeZ>(btVector3(
        scalar(cylinder->radius), scalar(cylinder->radius), scalar(cylinder->half_height)));
  if (const auto* capsule = std::get_if<Capsule>(&shape.kind))
    return std::make_unique<btCapsuleShapeZ>(scalar(capsule->radius),
                                             scalar(2 * capsule->half_height));
  if (const auto* cone = std::get_if<Cone>(&shape.kind))
    return std::make_unique<btConeShapeZ>(scalar(cone->radius), scalar(2 * cone->half_height));
  if (const auto* hull = std::get_if<Hull>(&shape.kind)) {
    auto points = std::make_unique<btConvexHullShape>();
    for (const Vec3<double>& p : hull->points.points()) points->addPoint(vector(p.cast<float>()));
    return points;
  }
  return nullptr;
}

/// Objects that a cast refers to.
struct Pair {
  std::unique_ptr<btConvexShape> shape;
  btSphereShape point{0};
  btGjkEpaPenetrationDepthSolver penetration;
};

template <class Caster>
bool run(Caster&& caster, const btTransform& from, const btTransform& to,
         btConvexCast::CastResult& result) {
  const btTransform still = btTransform::getIdentity();
  return caster.calcTimeOfImpact(from, to, still, still, result);
}

enum class Kind { subsimplex, gjk, continuous };

Hit entry(Pair& pair, Kind kind, const Ray<float>& ray) {
  btVoronoiSimplexSolver simplex;
  btTransform from, to;
  from.setIdentity();
  to.setIdentity();
  from.setOrigin(vector(ray.origin));
  to.setOrigin(vector(ray.at(ray.t_max)));
  btConvexCast::CastResult result;
  result.m_fraction = 1;
  bool met = false;
  switch (kind) {
    case Kind::subsimplex:
      met = run(btSubsimplexConvexCast(&pair.point, pair.shape.get(), &simplex), from, to, result);
      break;
    case Kind::gjk:
      met = run(btGjkConvexCast(&pair.point, pair.shape.get(), &simplex), from, to, result);
      break;
    case Kind::continuous:
      met = run(
          btContinuousConvexCollision(&pair.point, pair.shape.get(), &simplex, &pair.penetration),
          from, to, result);
      break;
  }
  if (!met) return {};
  Hit hit = hit_at(static_cast<double>(result.m_fraction) * static_cast<double>(ray.t_max));
  hit.normal =
      Vec3<float>(static_cast<float>(result.m_normal.x()), static_cast<float>(result.m_normal.y()),
                  static_cast<float>(result.m_normal.z()));
  return hit;
}

}  // namespace

Peers bullet(const Shape& shape) {
  Peers peers;
  for (const bool no_margin : {false, true}) {
    const auto pair = std::make_shared<Pair>();
    pair->shape = bullet_shape(shape);
    if (!pair->shape) return peers;
    pair->point.setMargin(0);
    // A sphere's and a capsule's margin is their radius.
    const bool is_round =
        std::holds_alternative<Sphere>(shape.kind) || std::holds_alternative<Capsule>(shape.kind);
    if (no_margin && is_round) continue;
    if (no_margin) pair->shape->setMargin(0);
    const std::string suffix = no_margin ? ", no margin/float" : "/float";
    const auto add = [&](const char* name, Kind kind) {
      peers.push_back(single_rays<float>(
          name + suffix, [pair, kind](const Ray<float>& ray) { return entry(*pair, kind, ray); }));
    };
    add("bullet-subsimplex", Kind::subsimplex);
    add("bullet-gjk", Kind::gjk);
    add("bullet-continuous", Kind::continuous);
  }
  return peers;
}

}  // namespace minkray::bench
