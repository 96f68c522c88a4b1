// SPDX-License-Identifier: MIT
// Rays without a direction are points, for any shape and solver.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "renderer/paper/solvers.h"
#include "tests/support/sample_shapes.h"

namespace minkray::testing {
namespace {

/// The middle of the shape's bounds may lie outside of it: these points are clearly in or clearly
/// out.
void check(const SampleShape& sample, const CastOptions& options) {
  const Shape shape = sample.shape;
  const PreparedShape prepared(shape);
  Vec3<double> within = Vec3<double>::Zero();
  double reach = 0, thickness = std::numeric_limits<double>::infinity();
  constexpr int directions = 26;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vec3<double> n(x, y, z);
        if (n.isZero(0)) continue;
        const Vec3<double> p = sample.shape.support(n), q = sample.shape.support(Vec3<double>(-n));
        within += p / directions;
        reach = std::max(reach, p.norm());
        thickness = std::min(thickness, n.dot(p - q) / n.norm());
      }
    }
  }
  const Vec3<double> none = Vec3<double>::Zero();
  const auto status = [&](const Vec3<double>& from) {
    return cast_ray(prepared, {from, none}, options).status;
  };
  if (thickness > 0.1 * reach) {
    EXPECT_EQ(name_of(status(within)), name_of(Status::inside));
  }
  for (const Vec3<double>& out : {Vec3<double>(1, 0.3, 0.2), Vec3<double>(-0.5, 1, -2)}) {
    EXPECT_EQ(name_of(status(within + 3 * reach * out)), name_of(Status::miss));
  }
}

TEST(NoDirection, is_a_point_inside_or_outside) {
  for (const SampleShape& sample : sample_shapes()) {
    for (const auto& solver : named_solvers) {
      SCOPED_TRACE(sample.name + " by " + std::string(solver.name));
      check(sample, {solver.kind});
    }
  }
}

}  // namespace
}  // namespace minkray::testing
