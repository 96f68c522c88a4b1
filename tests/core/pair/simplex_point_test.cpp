// SPDX-License-Identifier: MIT
// The point of a simplex nearest to the origin, and the weights of its vertices.
#include "core/pair/simplex_point.h"

#include <gtest/gtest.h>

#include "tests/core/pair_distance/random_numbers.h"

namespace minkray {
namespace {

TEST(SimplexPoint, is_what_its_weights_say_and_no_vertex_is_nearer_along_it) {
  testing::RandomNumbers random(51);
  int kept_all = 0;
  for (int k = 0; k < 8000; ++k) {
    const int n = 1 + k % 4;
    const Vec3<double> shift = random.in(0, 1.5) * random.direction();
    Vec3<double> y[4];
    for (Vec3<double>& corner : y) corner = random.direction() + shift;
    const SimplexPoint found = closest_of_simplex(y, n, false);
    Vec3<double> sum = Vec3<double>::Zero();
    double weights = 0;
    for (int i = 0; i < n; ++i) {
      ASSERT_GE(found.weight[i], 0) << k;
      ASSERT_TRUE((found.kept >> i & 1) != 0 || found.weight[i] == 0) << k;
      weights += found.weight[i];
      sum += found.weight[i] * y[i];
      // The plane through the point, at right angles to it, has all of the simplex behind it.
      ASSERT_GE(found.v.dot(y[i]), found.v.squaredNorm() - 1e-12) << k;
    }
    ASSERT_NEAR(weights, 1, 1e-13) << k;
    ASSERT_LT((sum - found.v).norm(), 1e-12) << k;
    kept_all += found.kept == (1u << n) - 1 ? 1 : 0;
  }
  EXPECT_GT(kept_all, 1000);
  EXPECT_LT(kept_all, 7000);
}

}  // namespace
}  // namespace minkray
