// SPDX-License-Identifier: MIT
// Bullet: casts as its btCollisionWorld makes them, distances by its pair detector with the EPA.
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <btBulletCollisionCommon.h>

#include <memory>

#include "bench/league/adapter.h"

namespace {

using namespace league;

btScalar scalar(double x) {
  return static_cast<btScalar>(x);
}
btVector3 vector(const Vec& v) {
  return {scalar(v[0]), scalar(v[1]), scalar(v[2])};
}

btTransform placed(const Solid& solid) {
  const Rows& m = solid.turn;
  return btTransform(btMatrix3x3(scalar(m[0][0]), scalar(m[0][1]), scalar(m[0][2]), scalar(m[1][0]),
                                 scalar(m[1][1]), scalar(m[1][2]), scalar(m[2][0]), scalar(m[2][1]),
                                 scalar(m[2][2])),
                     vector(solid.at));
}

/// Shapes with corners have no margin: Bullet's is 4 cm by default, whatever the unit.
std::shared_ptr<btConvexShape> shape_of(const Solid& solid) {
  const btScalar radius = scalar(solid.sizes[0]), height = scalar(2 * solid.sizes[1]);
  std::shared_ptr<btConvexShape> shape;
  switch (solid.kind) {
    case Kind::sphere:
      return std::make_shared<btSphereShape>(radius);
    case Kind::capsule:
      return std::make_shared<btCapsuleShapeZ>(radius, height);
    case Kind::box:
      shape = std::make_shared<btBoxShape>(vector(solid.sizes));
      break;
    case Kind::cylinder:
      shape = std::make_shared<btCylinderShapeZ>(btVector3(radius, radius, height / 2));
      break;
    case Kind::cone:
      shape = std::make_shared<btConeShapeZ>(radius, height);
      break;
    case Kind::hull: {
      auto hull = std::make_shared<btConvexHullShape>();
      for (const Vec& p : solid.points) hull->addPoint(vector(p), false);
      hull->recalcLocalAabb();
      shape = hull;
      break;
    }
    default:
      return nullptr;
  }
  shape->setMargin(0);
  return shape;
}

enum class Cast { subsimplex, gjk, continuous };

struct Pair {
  std::shared_ptr<btConvexShape> a, b;
  btTransform at_a, from, to;
};

Answer cast(const Pair& pair, Cast how, double t_max) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver penetration;
  btConvexCast::CastResult result;
  result.m_fraction = 1;
  const auto run = [&](auto&& caster) {
    return caster.calcTimeOfImpact(pair.from, pair.to, pair.at_a, pair.at_a, result);
  };
  bool met = false;
  if (how == Cast::subsimplex)
    met = run(btSubsimplexConvexCast(pair.b.get(), pair.a.get(), &simplex));
  else if (how == Cast::gjk)
    met = run(btGjkConvexCast(pair.b.get(), pair.a.get(), &simplex));
  else
    met = run(btContinuousConvexCollision(pair.b.get(), pair.a.get(), &simplex, &penetration));
  if (!met || result.m_fraction > 1) return miss();
  return hit(double(result.m_fraction) * t_max);
}

Ask prepare(const Query& query, Cast rays, Cast shapes) {
  Pair pair;
  pair.a = shape_of(query.a);
  if (query.asked == Asked::ray) {
    pair.b = std::make_shared<btSphereShape>(scalar(0));
    pair.b->setMargin(0);
  } else {
    pair.b = shape_of(query.b);
  }
  if (!pair.a || !pair.b) return [] { return unsupported("Bullet has no such shape"); };
  pair.at_a = placed(query.a);
  pair.from = placed(query.b);
  if (query.asked == Asked::ray)
    pair.from = btTransform(btMatrix3x3::getIdentity(), vector(query.origin));
  if (query.asked == Asked::ray || query.asked == Asked::shape) {
    pair.to = pair.from;
    Vec end = query.direction;
    for (double& x : end) x *= query.t_max;
    pair.to.setOrigin(pair.from.getOrigin() + vector(end));
    const Cast how = query.asked == Asked::ray ? rays : shapes;
    return [pair, how, t_max = query.t_max] { return cast(pair, how, t_max); };
  }
  return [pair, is_signed = query.asked == Asked::signed_distance] {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    btGjkPairDetector detector(pair.a.get(), pair.b.get(), &simplex, &penetration);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = pair.at_a;
    input.m_transformB = pair.from;
    btPointCollector output;
    detector.getClosestPoints(input, output, nullptr);
    if (!output.m_hasResult) return failed("no result");
    const double distance = double(output.m_distance);
    return at_distance(is_signed ? distance : std::max(0.0, distance));
  };
}

}  // namespace

int main(int argc, char** argv) {
  const std::string version =
      std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
  const std::string all =
      "float; margins 0; distances: btGjkPairDetector with btGjkEpaPenetrationDepthSolver; ";
  return serve(argc, argv,
               {{"bullet", version,
                 all + "rays: btSubsimplexConvexCast, shapes: btContinuousConvexCollision (as "
                       "btCollisionWorld by default)",
                 [](const Query& q) { return prepare(q, Cast::subsimplex, Cast::continuous); }},
                {"bullet-gjk", version, all + "casts: btGjkConvexCast",
                 [](const Query& q) { return prepare(q, Cast::gjk, Cast::gjk); }}});
}
