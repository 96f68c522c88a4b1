// SPDX-License-Identifier: MIT
// Plates, needles and blades: what is promised of the signed distances of ordinary shapes holds of
// them, too, where they nearly touch.
#include <gtest/gtest.h>

#include <array>

#include "tests/core/pair_distance/pair_judge.h"

namespace minkray::testing {
namespace {

class SlenderPairs : public ::testing::TestWithParam<double> {};

TEST_P(SlenderPairs, have_bounds_as_near_to_each_other_as_all_others) {
  RandomShapes random(23);
  std::array<int, 4> statuses = {};
  for (int k = 0; k < 3000; ++k) {
    const RandomPair pair = slender_pair(k, GetParam(), random);
    const SignedDistance found = signed_distance(pair.a, pair.b);
    ++statuses[static_cast<std::size_t>(found.status)];
    EXPECT_EQ(complaint(pair.a, pair.b, found, random), "") << "pair " << k;
  }
  // There are enough of each for a meaningful test.
  for (const SignedStatus status :
       {SignedStatus::separated, SignedStatus::touching, SignedStatus::overlapping})
    EXPECT_GT(statuses[static_cast<std::size_t>(status)], 300) << name_of(status);
}

INSTANTIATE_TEST_SUITE_P(Thin, SlenderPairs, ::testing::Values(30, 100, 1000, 10000));

}  // namespace
}  // namespace minkray::testing
