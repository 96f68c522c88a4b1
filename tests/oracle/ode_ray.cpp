// SPDX-License-Identifier: MIT
#include "tests/oracle/ode_ray.h"

#include <ode/ode.h>

namespace minkray::testing {
namespace {

/// ODE needs a call before and after; once for the whole program.
struct OdeLibrary {
  OdeLibrary() { dInitODE2(0); }
  ~OdeLibrary() { dCloseODE(); }
};

dReal real(double value) {
  return static_cast<dReal>(value);
}

dGeomID make_geom(const Shape& shape) {
  if (const auto* s = std::get_if<Sphere>(&shape.kind))
    return dCreateSphere(nullptr, real(s->radius));
  if (const auto* s = std::get_if<Capsule>(&shape.kind))
    return dCreateCapsule(nullptr, real(s->radius), real(2 * s->half_height));
  if (const auto* s = std::get_if<Cylinder>(&shape.kind))
    return dCreateCylinder(nullptr, real(s->radius), real(2 * s->half_height));
  if (const auto* s = std::get_if<Box>(&shape.kind)) {
    const Vec3<double> sides = 2 * s->half_extents;
    return dCreateBox(nullptr, real(sides.x()), real(sides.y()), real(sides.z()));
  }
  return nullptr;
}

}  // namespace

struct OdeRay::State {
  std::shared_ptr<OdeLibrary> library;
  dGeomID geom = nullptr, ray = nullptr;

  ~State() {
    dGeomDestroy(geom);
    dGeomDestroy(ray);
  }
};

OdeRay::OdeRay(std::unique_ptr<State> state) : state_(std::move(state)) {}
OdeRay::~OdeRay() = default;

std::unique_ptr<OdeRay> OdeRay::make(const Shape& shape) {
  static std::weak_ptr<OdeLibrary> shared;
  auto library = shared.lock();
  if (!library) shared = library = std::make_shared<OdeLibrary>();
  const dGeomID geom = make_geom(shape);
  if (geom == nullptr) return nullptr;
  auto state = std::make_unique<State>();
  state->library = std::move(library);
  state->geom = geom;
  state->ray = dCreateRay(nullptr, 1);
  return std::unique_ptr<OdeRay>(new OdeRay(std::move(state)));
}

double OdeRay::entry(const Ray<double>& ray) const {
  const double length = ray.direction.norm();
  const auto& o = ray.origin;
  const auto& d = ray.direction;
  dGeomRaySetLength(state_->ray, real(ray.t_max * length));
  dGeomRaySet(state_->ray, real(o.x()), real(o.y()), real(o.z()), real(d.x()), real(d.y()),
              real(d.z()));
  dContactGeom contact;
  if (dCollide(state_->ray, state_->geom, 1, &contact, sizeof contact) == 0)
    return std::numeric_limits<double>::infinity();
  return static_cast<double>(contact.depth) / length;
}

}  // namespace minkray::testing
