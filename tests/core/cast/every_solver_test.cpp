// SPDX-License-Identifier: MIT
// Guarantees of all solvers, including the slow references.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "renderer/paper/solvers.h"

namespace minkray::testing {
namespace {

using V = Vec3<double>;

// Algorithm 1 was only tested with hits.
TEST(Cast, of_every_solver_tells_hits_misses_and_insides_apart) {
  for (const auto& solver : named_solvers) {
    const CastOptions options{solver.kind};
    for (const Shape& shape : {Shape(Sphere{1}), Shape(Cylinder{1, 1})}) {
      const PreparedShape prepared(shape);
      const auto cast = [&](const V& origin, const V& direction) {
        return cast_ray(prepared, Ray<double>{origin, direction}, options);
      };
      const CastResult<double> hit = cast({-4, 0, 0}, {1, 0, 0});
      EXPECT_EQ(hit.status, Status::hit) << solver.name;
      EXPECT_NEAR(hit.t(), 3, 1e-7) << solver.name;
      EXPECT_LT(hit.normal.x(), -0.999) << solver.name;
      EXPECT_EQ(cast({0.25, 0.5, 0}, {1, 0, 0}).status, Status::inside) << solver.name;
      EXPECT_EQ(cast({0.25, 0.5, 0}, {1, 0, 0}).t(), 0) << solver.name;
      for (const V& from : {V(-4, 1.5, 0), V(4, 0, 0), V(-4, 0, 1.75)}) {
        const CastResult<double> miss = cast(from, {1, 0, 0});
        EXPECT_EQ(miss.status, Status::miss) << solver.name;
        EXPECT_GT(miss.normal.dot(from), miss.normal.dot(shape.support(miss.normal)))
            << solver.name;
      }
    }
  }
}

}  // namespace
}  // namespace minkray::testing
