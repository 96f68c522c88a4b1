// SPDX-License-Identifier: MIT
// Shapes of shapes made through handles: each may occur in the next, any number of times, up
// to the limits of queries.
#include <gtest/gtest.h>
#include <minkray/minkray_c.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace {

minkray_shape ball() {
  const double radius = 1;
  const minkray_parameter parameter = {"radius", &radius, 1, nullptr, 0};
  minkray_shape shape = {0};
  EXPECT_EQ(minkray_shape_make("sphere", &parameter, 1, &shape), MINKRAY_OK);
  return shape;
}

/// Puts `copies` of the shape into a sum, and that into the next; the code of the first that
/// fails, and the number made.
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

/// Forty sums of a shape with itself took a second to make, and queries never ended.
TEST(NestedShapes, are_at_most_a_million) {
  int made = 0;
  EXPECT_EQ(sums_of(2, 10, made), MINKRAY_OK);
  EXPECT_EQ(sums_of(2, 40, made), MINKRAY_WRONG_USE);
  EXPECT_EQ(made, 19);
}

int on_a_ball(void*, std::size_t count, const double (*n)[3], double (*p)[3]) {
  std::memcpy(p, n, count * sizeof *p);
  return 0;
}

minkray_shape superellipsoid(double size) {
  const double radii[3] = {size, 0.9 * size, 0.8 * size}, exponent = 3;
  const minkray_parameter parameters[2] = {{"radii", radii, 3, nullptr, 0},
                                           {"exponent", &exponent, 1, nullptr, 0}};
  minkray_shape shape = {0};
  EXPECT_EQ(minkray_shape_make("superellipsoid", parameters, 2, &shape), MINKRAY_OK);
  return shape;
}

/// With gathered support points, casts run on stacks of their own; shapes 499 deep overflowed
/// them.
TEST(NestedShapes, are_a_thousand_deep_beside_shapes_that_are_gathered) {
  const minkray_shape small = superellipsoid(1e-4);
  minkray_shape shape = superellipsoid(1);
  for (int i = 1; i < 1000; ++i) {
    const minkray_shape operands[2] = {shape, small};
    const minkray_parameter parameter = {"shapes", nullptr, 0, operands, 2};
    minkray_shape next = {0};
    ASSERT_EQ(minkray_shape_make("hull_of", &parameter, 1, &next), MINKRAY_OK)
        << minkray_last_error();
    minkray_shape_release(shape);
    shape = next;
  }
  const minkray_support function = {on_a_ball, nullptr, nullptr, nullptr, nullptr};
  minkray_shape gathered = {0};
  ASSERT_EQ(minkray_shape_custom_gathered(&function, 100, &gathered), MINKRAY_OK);
  minkray_scene scene = {0};
  ASSERT_EQ(minkray_scene_make(&scene), MINKRAY_OK);
  const minkray_pose above = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 9}}};
  ASSERT_EQ(minkray_scene_add(scene, shape, nullptr, nullptr, nullptr), MINKRAY_OK);
  ASSERT_EQ(minkray_scene_add(scene, gathered, &above, nullptr, nullptr), MINKRAY_OK);
  ASSERT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
  const std::vector<minkray_ray> rays(33, {{-5, 0.1, 0.2}, {1, 0, 0}, HUGE_VAL});
  std::vector<minkray_hit> hits(rays.size());
  ASSERT_EQ(minkray_scene_cast(scene, rays.data(), rays.size(), hits.data(), nullptr), MINKRAY_OK);
  for (const minkray_hit& hit : hits) EXPECT_EQ(hit.object, 0u);
  minkray_scene_release(scene);
  for (const minkray_shape one : {shape, small, gathered}) minkray_shape_release(one);
}

}  // namespace
