// SPDX-License-Identifier: MIT
// The point that support points span for a certificate: its weights are none below zero.
#include "core/proof/spanned_point.h"

#include <gtest/gtest.h>

namespace minkray::testing {
namespace {

using LongVec = Vec3<long double>;

TEST(SpannedPoint, keeps_its_weights_where_elimination_finds_some_below_zero) {
  SpannedPoint spanned(LongVec(0, 0, 0));
  const LongVec corners[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  for (const LongVec& corner : corners)
    ASSERT_TRUE(spanned.add(corner, corner.cast<double>().normalized()));
  ASSERT_TRUE(spanned.full());
  EXPECT_EQ(spanned.off(), 0);
  // From outside of the tetrahedron, no weights above zero span the spot.
  for (const LongVec& spot : {LongVec(0, 0, 0), LongVec(0.125, 0.0625, 0), LongVec(5, 0, 0)}) {
    spanned.move(spot);
    spanned.balance();
    Certificate certificate;
    spanned.write_to(certificate);
    const double expected =
        spot.x() > 1 ? (spot - LongVec(0.125, 0.0625, 0)).cast<double>().norm() : 0;
    double sum = 0;
    for (const WeightedSupport& term : certificate.spanning) {
      EXPECT_GT(term.weight, 0);
      sum += term.weight;
    }
    EXPECT_NEAR(sum, 1, 1e-15);
    EXPECT_NEAR(spanned.off(), expected, 1e-15);
  }
}

}  // namespace
}  // namespace minkray::testing
