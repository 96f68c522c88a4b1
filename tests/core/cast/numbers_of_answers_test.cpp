// SPDX-License-Identifier: MIT
// A result with any number out of range is none.
#include <gtest/gtest.h>

#include <limits>

#include "core/query/on_ray.h"
#include "core/query/result.h"

namespace minkray {
namespace {

TEST(NumbersOfAnswers, are_missed_one_by_one) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CastResult<double> answer;
  answer.t_base = 1;
  answer.t_offset = answer.offset_lo = answer.offset_hi = 0.5;
  const Vec3<double> normal(0, 0.6, 0.8);
  EXPECT_TRUE(has_numbers<double>(answer, normal));
  EXPECT_TRUE(has_numbers<double>(answer, Vec3<double>(0, 0, 0)));
  for (double CastResult<double>::*number :
       {&CastResult<double>::t_base, &CastResult<double>::t_offset, &CastResult<double>::offset_lo,
        &CastResult<double>::offset_hi}) {
    CastResult<double> without = answer;
    without.*number = nan;
    EXPECT_FALSE(has_numbers<double>(without, normal));
  }
  for (const double wrong : {nan, std::numeric_limits<double>::infinity(), 2.0})
    for (int axis = 0; axis < 3; ++axis) {
      Vec3<double> other = normal;
      other[axis] = wrong;
      EXPECT_FALSE(has_numbers<double>(answer, other));
    }
}

}  // namespace
}  // namespace minkray
