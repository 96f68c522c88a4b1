// SPDX-License-Identifier: MIT
// Sums, maps and inverses in twice the digits, compared with numbers of 113 bits.
#include "core/math/two_fold.h"

#include <gtest/gtest.h>

#include "tests/oracle/quad.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

using M = Mat3<double>;
using V = Vec3<double>;

using minkray::testing::quad;

Quad quad(const TwoFold<double>& x) {
  return Quad(x.high) + Quad(x.low);
}

TEST(TwoFold, differences_are_exact) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const V a = random.in_cube() * std::exp2(random.uniform(-20, 20)), b = random.in_cube();
    const TwoFoldVec3<double> difference = exact_difference<double>(a, b);
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(quad(difference[k]) == Quad(a[k]) - Quad(b[k]));
  }
}

TEST(TwoFold, points_go_there_and_back) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Affine<double> map{random.rotation(), random.in_cube() * 1e9};
    const TwoFoldVec3<double> x(random.in_cube()), image = image_of(map, x);
    const QuadVec exact = quad(map.translation) + map.linear.cast<Quad>() * quad(x.high);
    for (int k = 0; k < 3; ++k) EXPECT_LE(size_of(quad(image[k]) - exact[k]), 0x1p-100 * 1e9);
    const TwoFoldVec3<double> back = image - TwoFoldVec3<double>(map.translation);
    const V near = TwoFoldMat3<double>(M(map.linear.transpose())).high * back.rounded();
    EXPECT_LE((near - x.high).norm(), 4e-15);  // rotations are so far from orthogonal
  }
}

/// The inverse of a needle's map was known to as many digits less as the needle is thin.
TEST(TwoFold, inverses_are_rounded_once_whatever_the_condition) {
  Random random(3);
  for (const double thin : {1.0, 1e-3, 1e-6, 1e-8})
    for (int i = 0; i < 200; ++i) {
      const V scale(1, std::pow(thin, random.uniform()), thin);
      const TwoFoldMat3<double> map = TwoFoldMat3<double>(random.rotation()) *
                                      TwoFoldMat3<double>(M(scale.asDiagonal())) *
                                      TwoFoldMat3<double>(random.rotation());
      const M inverse = accurate_inverse(map);
      const double largest = inverse.cwiseAbs().maxCoeff();
      // Cramer's rule loses the square of the condition, of 113 bits: no thinner needles.
      const auto cofactor = [&](int a, int b) {
        const int i1 = (a + 1) % 3, i2 = (a + 2) % 3, j1 = (b + 1) % 3, j2 = (b + 2) % 3;
        return quad(map(i1, j1)) * quad(map(i2, j2)) - quad(map(i1, j2)) * quad(map(i2, j1));
      };
      Quad determinant = 0;
      for (int j = 0; j < 3; ++j) determinant += quad(map(0, j)) * cofactor(0, j);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          EXPECT_LE(size_of(Quad(inverse(a, b)) - cofactor(b, a) / determinant), 0x1p-52 * largest);
    }
}

TEST(TwoFold, what_has_no_inverse_has_no_numbers) {
  M flat;
  flat << 1, 2, 3, 2, 4, 6, 1, 0, 1;
  EXPECT_FALSE(accurate_inverse(TwoFoldMat3<double>(flat)).allFinite());
}

}  // namespace
}  // namespace minkray::testing
