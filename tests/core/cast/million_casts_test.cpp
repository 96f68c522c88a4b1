// SPDX-License-Identifier: MIT
// Compares a million casts with an oracle in long double: no hit is reported as a miss or the
// other way round, and no t is further off than promised. `./run bench --many` casts many more.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "tests/support/as_test_name.h"
#include "tests/support/cast_judge.h"
#include "tests/support/measured_shapes.h"
#include "tests/support/ray_families.h"
#include "tests/support/values_asked_for.h"

namespace minkray::testing {
namespace {

class MillionCasts : public ::testing::TestWithParam<MeasuredShape> {};

void expect_right(const MeasuredShape& measured, RayFamily family, int rays) {
  const PreparedShape prepared(measured.shape);
  const CastJudge judge(measured.same);
  FamilyRays source(measured.same, family, 77);
  int hits = 0;
  for (int i = 0; i < rays; ++i) {
    const Ray<double> ray = source.next();
    const CastResult<double> answer = cast_ray(prepared, ray);
    const TrueEntry truth = judge.truth(ray, answer.normal);
    const Judgement judged = judge(ray, answer, truth);
    ASSERT_NE(judged.verdict, Verdict::exhausted) << i;
    ASSERT_NE(judged.verdict, Verdict::undecided) << i;
    ASSERT_NE(judged.verdict, Verdict::wrong) << name_of(answer.status) << " at ray " << i;
    if (judged.verdict != Verdict::right || answer.status != Status::hit) continue;
    ++hits;
    ASSERT_LE(judged.error, allowed_error) << i;
    ASSERT_LE(judge.error_by_bound(ray, answer, truth), 1) << i;
  }
  EXPECT_GT(hits, rays / 50);
  EXPECT_LT(hits, rays);
}

TEST_P(MillionCasts, are_right) {
  expect_right(GetParam(), RayFamily::random, 30000);
  expect_right(GetParam(), RayFamily::grazing, 4000);
}

INSTANTIATE_TEST_SUITE_P(Shapes, MillionCasts, values_asked_for<MillionCasts>(measured_shapes),
                         [](const auto& tested) { return as_test_name(tested.param.name); });

class DerivedCasts : public ::testing::TestWithParam<MeasuredShape> {};

// Degenerate rays touch rims and faces, where rounding of support points moves a bound most.
TEST_P(DerivedCasts, are_right) {
  expect_right(GetParam(), RayFamily::random, 2000);
  expect_right(GetParam(), RayFamily::grazing, 500);
  expect_right(GetParam(), RayFamily::degenerate, 1000);
}

INSTANTIATE_TEST_SUITE_P(Shapes, DerivedCasts, values_asked_for<DerivedCasts>(derived_shapes),
                         [](const auto& tested) { return as_test_name(tested.param.name); });

TEST(CastJudge, notices_what_is_wrong) {
  const Shape box = Box{{1, 1, 1}};
  const CastJudge judge(box);
  const double R = std::sqrt(3.0);
  const Ray<double> ray{{-5, 0.5, 0.25}, {2, 0, 0}};
  const TrueEntry truth = judge.truth(ray, {-1, 0, 0});
  EXPECT_DOUBLE_EQ(static_cast<double>(truth.entry.t), 2);
  EXPECT_DOUBLE_EQ(truth.cosine, 1);
  EXPECT_DOUBLE_EQ(judge.truth(ray, {-0.1, 0, 1}).cosine, 1) << "of no normal there";

  CastResult<double> answer = cast_ray(PreparedShape(box), ray);
  EXPECT_EQ(judge(ray, answer, truth).verdict, Verdict::right);
  EXPECT_LE(judge(ray, answer, truth).error, allowed_error);
  answer.t_offset += 1e-6;
  EXPECT_NEAR(judge(ray, answer, truth).error, 2e-6 / R, 1e-12);
  // A normal nearly across the ray makes it no better.
  answer.normal = {-1e-9, 0, 1};
  EXPECT_NEAR(judge(ray, answer, truth).error, 2e-6 / R, 1e-12);
  answer.status = Status::miss;
  EXPECT_EQ(judge(ray, answer, truth).verdict, Verdict::wrong);
  answer.status = Status::exhausted;
  EXPECT_EQ(judge(ray, answer, truth).verdict, Verdict::exhausted);

  const Ray<double> past{{-5, 1.0000001, 0}, {2, 0, 0}};
  answer.status = Status::hit;
  EXPECT_EQ(judge(past, answer, judge.truth(past, {0, 1, 0})).verdict, Verdict::wrong);
}

}  // namespace
}  // namespace minkray::testing
