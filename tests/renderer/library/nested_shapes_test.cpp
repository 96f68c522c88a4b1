// SPDX-License-Identifier: MIT
// Shapes of shapes made through handles: each may stand in the next, as often as a program likes,
// until that is more than anybody can ask.
#include <gtest/gtest.h>
#include <minkray/minkray_c.h>

#include <string>

namespace {

minkray_shape ball() {
  const double radius = 1;
  const minkray_parameter parameter = {"radius", &radius, 1, nullptr, 0};
  minkray_shape shape = {0};
  EXPECT_EQ(minkray_shape_make("sphere", &parameter, 1, &shape), MINKRAY_OK);
  return shape;
}

/// Puts the shape into a sum, so many times, and that into the next; the code of the first that
/// fails, and how many were made.
int sums_of(std::size_t copies, int most, int& made) {
  minkray_shape shape = ball();
  int code = MINKRAY_OK;
  for (made = 0; made < most && code == MINKRAY_OK; ++made) {
    const minkray_shape operands[2] = {shape, shape};
    const minkray_parameter parameter = {"shapes", nullptr, 0, operands, copies};
    minkray_shape sum = {0};
    code = minkray_shape_make("minkowski_sum", &parameter, 1, &sum);
    if (code != MINKRAY_OK) break;
    EXPECT_EQ(minkray_shape_release(shape), MINKRAY_OK);
    shape = sum;
  }
  const double x[1][3] = {{1, 0, 0}};
  double point[1][3];
  const std::string error = minkray_last_error();
  EXPECT_EQ(minkray_shape_support(shape, 1, x, point), MINKRAY_OK);
  if (copies == 1) {
    EXPECT_DOUBLE_EQ(point[0][0], 1);
  } else {
    EXPECT_DOUBLE_EQ(point[0][0], double(1 << made));
  }
  EXPECT_EQ(minkray_shape_release(shape), MINKRAY_OK);
  const bool is_told = error.find(copies == 1 ? "deep" : "shapes in it") != std::string::npos;
  EXPECT_TRUE(code == MINKRAY_OK || is_told) << error;
  return code;
}

/// The 100,000th ended the program: the stack was full.
TEST(NestedShapes, are_at_most_a_thousand_deep) {
  int made = 0;
  EXPECT_EQ(sums_of(1, 900, made), MINKRAY_OK);
  EXPECT_EQ(sums_of(1, 100'000, made), MINKRAY_WRONG_USE);
  EXPECT_EQ(made, 999);
}

/// Forty sums of a shape with itself took a second to make, and for ever to ask.
TEST(NestedShapes, are_at_most_a_million) {
  int made = 0;
  EXPECT_EQ(sums_of(2, 10, made), MINKRAY_OK);
  EXPECT_EQ(sums_of(2, 40, made), MINKRAY_WRONG_USE);
  EXPECT_EQ(made, 19);
}

}  // namespace
