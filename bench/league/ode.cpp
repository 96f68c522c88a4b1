// SPDX-License-Identifier: MIT
// The Open Dynamics Engine: its rays, and the deepest of its contacts.
#include <ode/ode.h>

#include <cmath>
#include <memory>

#include "bench/league/adapter.h"

namespace {

using namespace league;

using Geom = std::shared_ptr<dxGeom>;

Geom placed(dGeomID geom, const Solid& solid) {
  const Rows& m = solid.turn;
  const dMatrix3 turn = {m[0][0], m[0][1], m[0][2], 0,       m[1][0], m[1][1],
                         m[1][2], 0,       m[2][0], m[2][1], m[2][2], 0};
  dGeomSetPosition(geom, solid.at[0], solid.at[1], solid.at[2]);
  dGeomSetRotation(geom, turn);
  return Geom(geom, dGeomDestroy);
}

Geom shape_of(const Solid& solid) {
  const double radius = solid.sizes[0], height = 2 * solid.sizes[1];
  switch (solid.kind) {
    case Kind::sphere:
      return placed(dCreateSphere(nullptr, radius), solid);
    case Kind::capsule:
      return placed(dCreateCapsule(nullptr, radius, height), solid);
    case Kind::cylinder:
      return placed(dCreateCylinder(nullptr, radius, height), solid);
    case Kind::box:
      return placed(dCreateBox(nullptr, 2 * solid.sizes[0], 2 * solid.sizes[1], 2 * solid.sizes[2]),
                    solid);
    default:
      return nullptr;
  }
}

Ask prepare(const Query& query) {
  const Geom a = shape_of(query.a);
  if (!a) return [] { return unsupported("ODE has no such shape, or needs its planes"); };
  if (query.asked == Asked::ray) {
    const double speed = std::hypot(query.direction[0], query.direction[1], query.direction[2]);
    if (!(speed > 0)) return [] { return unsupported("a ray without a direction"); };
    const Geom ray(dCreateRay(nullptr, query.t_max * speed), dGeomDestroy);
    dGeomRaySet(ray.get(), query.origin[0], query.origin[1], query.origin[2], query.direction[0],
                query.direction[1], query.direction[2]);
    return [a, ray, speed] {
      dContactGeom contact;
      if (dCollide(ray.get(), a.get(), 1, &contact, sizeof contact) == 0) return miss();
      return hit(contact.depth / speed);
    };
  }
  if (query.asked != Asked::signed_distance)
    return [] { return unsupported("ODE has contacts alone"); };
  const Geom b = shape_of(query.b);
  if (!b) return [] { return unsupported("ODE has no such shape, or needs its planes"); };
  return [a, b] {
    constexpr int most = 64;
    dContactGeom contacts[most];
    const int count = dCollide(a.get(), b.get(), most, contacts, sizeof contacts[0]);
    if (count == 0) return Answer{Answer::Status::separated};
    double depth = 0;
    for (int i = 0; i < count; ++i) depth = std::max(depth, double(contacts[i].depth));
    return at_distance(-depth);
  };
}

}  // namespace

int main(int argc, char** argv) {
  dInitODE2(0);
  return serve(
      argc, argv,
      {{"ode", ODE_LEAGUE_VERSION, "double; dCollide, the deepest of 64 contacts", prepare}});
}
