// SPDX-License-Identifier: MIT
// Selection of shapes for closed forms: all those with useful error bounds, and no others.
#include <gtest/gtest.h>

#include <numbers>

#include "core/cast/cast.h"
#include "core/exact/frustum.h"
#include "core/exact/tapered_capsule.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

using S = Shape;
using P = Vec3<double>;

/// Rays at a spot near the top of a pyramid of `sides` sides, grown by a radius.
TEST(LimitsOfForms, corners_of_many_edges_are_answered_in_closed_form) {
  for (const int sides : {12, 50, 120, 240}) {
    std::vector<P> points = {{0, 0, 1}, {0, 0, -0.5}};
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      points.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    const PreparedShape pyramid(S(Rounded{0.3, Nested(S(Hull{PointCloud(points)}))}));
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

/// The flatter a triangle is, the more rounding hides adjacent features: bounds of flat ones would
/// be wide, where models are better.
TEST(LimitsOfForms, hits_of_rounded_slivers_have_narrow_bounds) {
  Random random(53);
  for (double power = -16; power <= -8; power += 0.5) {
    const S sliver = Triangle{{P(-1, 0, 0), P(1, 0, 0), P(0.1, std::exp2(power), 0)}};
    const PreparedShape rounded(S(Rounded{0.25, Nested(sliver)}));
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
    const PreparedShape cut(S(CutCylinder{2, {0, height}, {0.25, -0.5}, {-0.125, 0}}));
    return cut.definition().form().kind != FormKind::none;
  };
  const double touching = 2 * std::hypot(0.375, 0.5);
  for (const double share : {1 - 6e-16, 1.0, 1 + 1e-15, 1.5, 20.0})
    EXPECT_TRUE(has_form(share * touching));
  for (const double share : {1 - 4e-15, 1 - 1e-14, 1 - 1e-7, 0.9, 0.5, 0.11})
    EXPECT_FALSE(has_form(share * touching));
}

/// The apex of a mantle that hardly narrows is far away, where its bounds would be wide.
TEST(LimitsOfForms, frustums_whose_apex_is_far_away_have_no_form) {
  for (const double radii : {1.0, 4.0, 7.9, 8.1, 20.0, 70.0}) {
    // With a height of 2 and a radius of 1 below, the apex is at 1 + 2 upper / (1 - upper).
    const double above = (radii * std::sqrt(2.0) - 1) / 2, upper = above / (1 + above);
    const PreparedShape frustum(S(Frustum{{1, upper}, 1}));
    EXPECT_EQ(frustum.definition().form().kind == exact::FrustumForm::kind, radii < 8) << radii;
  }
}

TEST(LimitsOfForms, tapered_capsules_with_hardly_a_ball_at_an_end_have_no_form) {
  for (const double share : {0x1p-1, 0x1p-8, 0x1.2p-10, 0x1.dp-11, 0x1p-13}) {
    const PreparedShape tapered(S(TaperedCapsule{{1, share}, 2}));
    EXPECT_EQ(tapered.definition().form().kind == exact::TaperedCapsuleForm::kind, share > 0x1p-10)
        << share;
  }
}

TEST(LimitsOfForms, tapered_capsules_whose_mantle_is_hardly_one_have_no_form) {
  for (const double sine : {0.05, 0.5, 0.985, 0.995}) {
    const PreparedShape tapered(S(TaperedCapsule{{1, 0.1}, 0.45 / sine}));
    EXPECT_EQ(tapered.definition().form().kind == exact::TaperedCapsuleForm::kind, sine < 0.99)
        << sine;
  }
}

/// If directions are so long or so short that their numbers have room for few sizes, other solvers
/// run, with the same result.
TEST(LimitsOfForms, directions_of_unusual_length_are_answered_by_models) {
  const PreparedShape ball(S(Sphere{1}));
  const P origin(-3, 0.25, -0.5);
  const double lambda = 3 - std::sqrt(1 - origin.y() * origin.y() - origin.z() * origin.z());
  for (const double length : {0.6e-250, 1.5e-250, 1e-9, 1.0, 1e9, 0.6e250, 1.5e250}) {
    const CastResult<double> answer = cast_ray(ball, {origin, {length, 0, 0}});
    ASSERT_EQ(name_of(answer.status), name_of(Status::hit)) << length;
    EXPECT_NEAR(answer.t() * length, lambda, 1e-14) << length;
    EXPECT_EQ(answer.path == Path::filter, length > 1e-250 && length < 1e250) << length;
  }
}

}  // namespace
}  // namespace minkray::testing
