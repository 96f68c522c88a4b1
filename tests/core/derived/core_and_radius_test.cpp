// SPDX-License-Identifier: MIT
// Cores of shapes under maps: what is tiny has the same core as what is not, but for its unit.
#include "core/derived/core_and_radius.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/sample_shapes.h"

namespace minkray {
namespace {

/// Maps of each sort that is looked for: of all lengths, along the axes, and neither.
std::vector<Mat3<double>> maps() {
  const Mat3<double> turn = rotation_matrix(0.1, -0.5, 0.1, std::sqrt(0.73));
  Mat3<double> shear = Mat3<double>::Identity();
  shear(0, 1) = 0.25;
  return {2 * Mat3<double>::Identity(), 0.75 * turn, turn * Vec3<double>(1, 2, 0.5).asDiagonal(),
          shear};
}

/// A unit whose square is no number.
constexpr int tiny = -530;

/// Relative: lengths of what is tiny are scaled on the way, which rounds them once or twice more.
constexpr double rounding = 4e-16;

void expect_scaled(double small, double large, const char* what) {
  EXPECT_NEAR(std::ldexp(small, -tiny), large, rounding * std::abs(large)) << what;
}

TEST(Cores, of_shapes_whose_squares_are_no_numbers_are_the_same_but_for_the_unit) {
  for (const testing::SampleShape& sample : testing::sample_shapes()) {
    for (const Mat3<double>& linear : maps()) {
      SCOPED_TRACE(sample.name);
      const Mat3<double> down = linear * std::ldexp(1.0, tiny);
      const CoreAndRadius large = core_and_radius(sample.shape, {linear, Vec3<double>::Zero()});
      const CoreAndRadius small = core_and_radius(sample.shape, {down, Vec3<double>::Zero()});
      ASSERT_EQ(small.core.kind, large.core.kind) << linear;
      EXPECT_EQ(small.core.count, large.core.count);
      expect_scaled(small.core.radius, large.core.radius, "radius");
      expect_scaled(small.core.ball, large.core.ball, "ball");
      for (int i = 0; i < 3; ++i) {
        expect_scaled(small.core.size[i], large.core.size[i], "size");
        expect_scaled(small.middle[i], large.middle[i], "middle");
      }
      EXPECT_LE((small.turn - large.turn).cwiseAbs().maxCoeff(), rounding);
    }
  }
}

TEST(Cores, of_maps_with_columns_of_all_lengths_are_boxes_only_at_right_angles) {
  const Shape box(Box{{1, 1, 1}});
  const Vec3<double> lengths(1e-200, 1, 1e-170);
  Mat3<double> shear = Mat3<double>::Identity();
  shear(0, 2) = 0.25;
  EXPECT_EQ(core_and_radius(box, {lengths.asDiagonal(), Vec3<double>::Zero()}).core.kind,
            CoreKind::box);
  const Mat3<double> sheared = shear * lengths.asDiagonal();
  EXPECT_EQ(core_and_radius(box, {sheared, Vec3<double>::Zero()}).core.kind, CoreKind::other);
}

}  // namespace
}  // namespace minkray
