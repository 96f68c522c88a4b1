// SPDX-License-Identifier: MIT
// Derivatives of distances and depths are slopes of distances found otherwise, in long double
// (./run many-derivatives has a million pairs).
#include <gtest/gtest.h>

#include "tests/core/pair_derivative/derivative_judge.h"
#include "tests/support/number_of_cases.h"

namespace minkray::testing {
namespace {

TEST(DerivativeOracle, agrees_on_random_pairs_of_all_kinds) {
  RandomShapes random(63);
  int smooth = 0, needless = 0, bounded = 0;
  const int cases = number_of_cases(2000);
  for (int n = 0; n < cases; ++n) {
    const int i = n % kinds_of_derived_bodies,
              j = n / kinds_of_derived_bodies % kinds_of_derived_bodies;
    const RandomPair pair = derived_pair(i, j, n % 120, random);
    const JudgedDerivative judged = DerivativeJudge(pair.a, pair.b, random, n % 16 == 0).judged();
    ASSERT_TRUE(judged.is_global) << n;
    ASSERT_FALSE(judged.slope == Slope::ridge && !judged.is_flagged) << n;
    if (judged.slope != Slope::smooth) continue;
    ++smooth;
    needless += judged.is_flagged ? 1 : 0;
    bounded += std::isfinite(judged.bound) ? 1 : 0;
    ASSERT_TRUE(judged.is_within) << n;
    // Rounding of a distance next to the distance itself is what a normal leans by.
    const double allowed = std::max(1e-6, 1e-10 / std::abs(judged.value));
    ASSERT_TRUE(judged.is_flagged || judged.error <= allowed) << n << ": " << judged.error;
  }
  EXPECT_GT(smooth, cases * 9 / 10);
  EXPECT_GT(bounded, cases / 2);
  EXPECT_LE(needless, 1 + cases / 1000);
}

TEST(DerivativeOracle, agrees_where_ridges_are) {
  RandomShapes random(64);
  int ridges = 0;
  for (int n = 0; n < number_of_cases(300); ++n) {
    const RandomPair pair =
        aligned_pair(n % kinds_of_aligned_bodies, n / kinds_of_aligned_bodies, random);
    const JudgedDerivative judged = DerivativeJudge(pair.a, pair.b, random, true).judged();
    if (judged.slope != Slope::ridge) continue;
    ++ridges;
    ASSERT_TRUE(judged.is_flagged) << n;
  }
  EXPECT_GT(ridges, 30);
}

}  // namespace
}  // namespace minkray::testing
