// SPDX-License-Identifier: MIT
// Which shapes closed forms are asked about: all that their error bounds are worth something for,
// and no others.
#include <gtest/gtest.h>

#include <numbers>

#include "core/cast/cast.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

using S = Shape<double>;
using P = Vec3<double>;

/// Rays at a spot near the top of a pyramid of so many sides, grown by a radius.
TEST(LimitsOfForms, corners_of_many_edges_are_answered_in_closed_form) {
  for (const int sides : {12, 50, 120, 240}) {
    std::vector<P> points = {{0, 0, 1}, {0, 0, -0.5}};
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      points.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    const PreparedShape<double> pyramid(
        S(Rounded<double>{0.3, Nested<double>(S(Hull<double>{PointCloud<double>(points)}))}));
    Random random(51);
    int in_doubt = 0;
    for (int i = 0; i < 300; ++i) {
      const P spot = P(0, 0, 1) + 0.15 * random.in_cube();
      const P from = spot + P(random.uniform(-1, 1), random.uniform(-1, 1), 3);
      const CastResult<double> answer = cast_ray(pyramid, {from, P(spot - from)});
      ASSERT_EQ(name_of(answer.status), name_of(Status::hit));
      in_doubt += answer.path != Path::filter;
    }
    EXPECT_EQ(in_doubt, 0) << sides;
  }
}

/// Rounding hides more of the features beside the flatter a triangle is: bounds of flat ones would
/// be wide, where models know better.
TEST(LimitsOfForms, hits_of_rounded_slivers_have_narrow_bounds) {
  Random random(53);
  for (double power = -16; power <= -8; power += 0.5) {
    const S sliver = Triangle<double>{{P(-1, 0, 0), P(1, 0, 0), P(0.1, std::exp2(power), 0)}};
    const PreparedShape<double> rounded(S(Rounded<double>{0.25, Nested<double>(sliver)}));
    double widest = 0;
    for (int i = 0; i < 300; ++i) {
      const P spot(random.uniform(-0.9, 0.9), random.uniform(-0.05, 0.05), 0);
      const P from = spot + P(random.uniform(-1, 1), random.uniform(-1, 1), 3);
      const CastResult<double> answer = cast_ray(rounded, {from, unit<double>(spot - from)});
      ASSERT_EQ(name_of(answer.status), name_of(Status::hit));
      widest = std::max(widest, answer.offset_hi - answer.offset_lo);
    }
    EXPECT_LT(widest, 0x1p-34) << "of height 2^" << power;
  }
}

/// The form is the part of a cylinder between two planes: it is the shape only where these do not
/// cross within it, but for what double rounds.
TEST(LimitsOfForms, planes_that_cross_within_a_cylinder_have_no_form) {
  const auto has_form = [](double height) {
    const PreparedShape<double> cut(
        S(CutCylinder<double>{2, {0, height}, {0.25, -0.5}, {-0.125, 0}}));
    return cut.definition().form().kind != FormKind::none;
  };
  const double touching = 2 * std::hypot(0.375, 0.5);
  for (const double share : {1.0, 1 + 1e-15, 1.5, 20.0}) EXPECT_TRUE(has_form(share * touching));
  for (const double share : {1 - 1e-14, 1 - 1e-7, 0.9, 0.5, 0.11})
    EXPECT_FALSE(has_form(share * touching));
}

}  // namespace
}  // namespace minkray::testing
