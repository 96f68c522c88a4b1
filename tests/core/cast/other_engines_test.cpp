// SPDX-License-Identifier: MIT
// Compares casts in double with the ray functions of MuJoCo and ODE, which have a formula for each
// shape.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "tests/support/ray_families.h"
#ifdef MINKRAY_MUJOCO
#include "tests/oracle/mujoco_ray.h"
#endif
#ifdef MINKRAY_ODE
#include "tests/oracle/ode_ray.h"
#endif

namespace minkray::testing {
namespace {

using S = Shape;

std::vector<S> primitives() {
  return {Sphere{1.3}, Capsule{0.5, 1}, Ellipsoid{{1, 0.5, 0.25}}, Cylinder{0.7, 1},
          Box{{1, 0.5, 0.25}}};
}

/// `entry` is the engine's. Both miss or both hit, and then at spots that are equally far along the
/// normal. A quadratic's root is rounded to the size of b^2, the distance of the origin squared.
template <class Entry>
int agreeing(const S& shape, const Entry& entry) {
  constexpr double t_max = 20, allowed = 1e-12;  // of the radius, along the normal
  const PreparedShape prepared(shape);
  FamilyRays rays(shape, RayFamily::random, 61);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    Ray<double> ray = rays.next();
    ray.t_max = t_max;
    const CastResult<double> ours = cast_ray(prepared, ray);
    const double theirs = entry(ray);
    EXPECT_EQ(ours.status == Status::hit, std::isfinite(theirs)) << "ray " << i;
    if (ours.status != Status::hit || !std::isfinite(theirs)) continue;
    ++hits;
    EXPECT_LE(std::abs(ours.t() - theirs) * std::abs(ours.normal.dot(ray.direction)),
              allowed * rays.ball().radius)
        << "ray " << i;
  }
  return hits;
}

#ifdef MINKRAY_MUJOCO
TEST(OtherEngines, mujoco_answers_the_same) {
  int shapes = 0;
  for (const S& shape : primitives()) {
    const auto mujoco = MujocoRay::make(shape);
    if (!mujoco) continue;
    ++shapes;
    EXPECT_GT(agreeing(shape, [&](const Ray<double>& ray) { return mujoco->entry(ray); }), 500);
  }
  EXPECT_EQ(shapes, 5);
}
#endif

#ifdef MINKRAY_ODE
TEST(OtherEngines, ode_answers_the_same) {
  int shapes = 0;
  for (const S& shape : primitives()) {
    const auto ode = OdeRay::make(shape);
    if (!ode) continue;
    ++shapes;
    EXPECT_GT(agreeing(shape, [&](const Ray<double>& ray) { return ode->entry(ray); }), 500);
  }
  EXPECT_EQ(shapes, 4);
}
#endif

}  // namespace
}  // namespace minkray::testing
