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

TEST(SlenderBodies, points_of_a_slight_overlap_belong_to_both) {
  // A cone overlaps a rod by 4e-13 of the size. A point of the cone's surface that is aside by 3e-8
  // is outside of the cone.
  constexpr double thin = 0.02343236785444134;
  Affine<double> of_rod, of_cone;
  of_rod.linear << -0.3684277681068171, -0.39024538904298889, 0.84378286070440878,
      -0.75225916970997064, -0.4081425681244788, -0.51722894898876348, 0.54622991612973304,
      -0.82530490148516711, -0.14319461690113711;
  of_cone.linear << -0.70010772297872048, -0.63025675612281273, -0.33559737422557462,
      -0.4225285625558774, -0.013202188430584849, 0.90625345022521542, -0.57560297953538686,
      0.77627451560784388, -0.25705852712522925;
  of_cone.translation << 0.25763168735768033, -0.86698928688243304, 0.29215271747628524;
  const Body rod(Cylinder{thin, 1}, of_rod), cone(Cone{thin, 1}, of_cone);
  RandomShapes random(29);
  EXPECT_EQ(complaint(rod, cone, signed_distance(rod, cone), random), "");
  EXPECT_EQ(complaint(cone, rod, signed_distance(cone, rod), random), "");
}

INSTANTIATE_TEST_SUITE_P(Thin, SlenderPairs, ::testing::Values(30, 100, 1000, 10000));

}  // namespace
}  // namespace minkray::testing
