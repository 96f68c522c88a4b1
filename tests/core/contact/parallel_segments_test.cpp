// SPDX-License-Identifier: MIT
// Segments and capsules that are parallel, or nearly so, beside or in one another. The normal came
// of a cross product that was nothing but rounding: capsules on one line had a normal along it, as
// deep as their lengths instead of their radii. Of the pairs here every fifth was wrong.
#include <gtest/gtest.h>

#include "tests/core/contact/pair_judge.h"

namespace minkray {
namespace {

using testing::Body;
using testing::RandomShapes;

TEST(ParallelSegments, nearly_so_have_planes_and_points_that_hold) {
  RandomShapes random(5), judge(6);
  int overlapping = 0, all = 0;
  for (int k = 0; k < 60000; ++k) {
    const Mat3<double> turn = random.turn();
    const auto little = [&] {
      return random.in(0, 1) < 0.3 ? 0.0 : std::pow(10, random.in(-17, -1));
    };
    const bool is_grown = k % 2 == 0;
    const auto shape = [&](double scale) -> Shape<double> {
      const Vec3<double> half(0, 0, scale * random.in(0.1, 1));
      const Shape<double> segment = Segment<double>{{-half, half}};
      if (!is_grown) return segment;
      return Rounded<double>{random.in(0, 0.5), Nested<double>(segment)};
    };
    const Body a(shape(k % 7 == 0 ? std::pow(10, random.in(-3, 3)) : 1),
                 {turn, Vec3<double>::Zero()});
    const double x = little(), y = little(), along = k % 3 == 0 ? 0 : random.in(-2, 2),
                 tilt_x = little(), tilt_y = little();
    const Body b(shape(1), {turn * rotation_matrix(tilt_x, tilt_y, 0.0, 1.0),
                            turn * Vec3<double>(x, y, along)});
    const SignedDistance found = signed_distance(a.ready, a.pose, b.ready, b.pose);
    ASSERT_EQ(testing::complaint(a, b, found, judge), "") << k;
    overlapping += found.status == SignedStatus::overlapping;
    ++all;
  }
  EXPECT_GT(overlapping, all / 4);
  EXPECT_LT(overlapping, all * 3 / 4);
}

TEST(ParallelSegments, capsules_on_one_line_leave_it_sideways) {
  const ContactShape capsule(Shape<double>(Capsule<double>{0.25, 1}));
  const Mat3<double> turn = rotation_matrix(0.3, -0.2, 0.7, 0.6);
  const Affine<double> one{turn, {0, 0, 0}}, two{turn, turn * Vec3<double>(0, 0, 0.125)};
  const SignedDistance found = signed_distance(capsule, one, capsule, two);
  EXPECT_NEAR(found.value, -0.5, 1e-14);
  EXPECT_NEAR(found.normal.dot(turn.col(2)), 0, 1e-14);
}

}  // namespace
}  // namespace minkray
