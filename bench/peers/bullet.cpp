// SPDX-License-Identifier: MIT
#include "bench/peers/bullet_cast.h"

#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <btBulletCollisionCommon.h>

namespace minkray::bench {

struct BulletCast::State {
  std::unique_ptr<btConvexShape> shape;
  btSphereShape point{0};
};

namespace {

template <class T>
btScalar scalar(T value) {
  return static_cast<btScalar>(value);
}

btVector3 vector(const Vec3<float>& v) {
  return {scalar(v.x()), scalar(v.y()), scalar(v.z())};
}

std::unique_ptr<btConvexShape> bullet_shape(const Shape<double>& shape) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape.kind))
    return std::make_unique<btSphereShape>(scalar(sphere->radius));
  if (const auto* box = std::get_if<Box<double>>(&shape.kind))
    return std::make_unique<btBoxShape>(vector(box->half_extents.cast<float>()));
  if (const auto* cylinder = std::get_if<Cylinder<double>>(&shape.kind))
    return std::make_unique<btCylinderShapeZ>(btVector3(
        scalar(cylinder->radius), scalar(cylinder->radius), scalar(cylinder->half_height)));
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape.kind))
    return std::make_unique<btCapsuleShapeZ>(scalar(capsule->radius),
                                             scalar(2 * capsule->half_height));
  if (const auto* cone = std::get_if<Cone<double>>(&shape.kind))
    return std::make_unique<btConeShapeZ>(scalar(cone->radius), scalar(2 * cone->half_height));
  if (const auto* hull = std::get_if<Hull<double>>(&shape.kind)) {
    auto points = std::make_unique<btConvexHullShape>();
    for (const Vec3<double>& p : hull->points.points()) points->addPoint(vector(p.cast<float>()));
    return points;
  }
  return nullptr;
}

}  // namespace

BulletCast::BulletCast(std::unique_ptr<State> state) : state_(std::move(state)) {}
BulletCast::~BulletCast() = default;

std::unique_ptr<BulletCast> BulletCast::make(const Shape<double>& shape) {
  auto state = std::make_unique<State>();
  state->shape = bullet_shape(shape);
  state->point.setMargin(0);
  if (!state->shape) return nullptr;
  return std::unique_ptr<BulletCast>(new BulletCast(std::move(state)));
}

float BulletCast::entry(const Ray<float>& ray) const {
  btVoronoiSimplexSolver simplex;
  btSubsimplexConvexCast caster(&state_->point, state_->shape.get(), &simplex);
  btTransform from, to;
  from.setIdentity();
  to.setIdentity();
  from.setOrigin(vector(ray.origin));
  to.setOrigin(vector(ray.at(ray.t_max)));
  const btTransform still = btTransform::getIdentity();
  btConvexCast::CastResult result;
  result.m_fraction = 1;
  if (!caster.calcTimeOfImpact(from, to, still, still, result))
    return std::numeric_limits<float>::infinity();
  return static_cast<float>(result.m_fraction) * ray.t_max;
}

}  // namespace minkray::bench
