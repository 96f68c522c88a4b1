// SPDX-License-Identifier: MIT
#include "core/math/slab_test.h"

#include <gtest/gtest.h>

#include <random>

namespace minkray {
namespace {

template <class T>
class Slab : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Slab, Scalars);

template <class T>
T entry(const Ray<T>& ray, const float (&planes)[2][3]) {
  return slab_entry(SlabRay<T>(ray), planes, ray.t_max);
}
template <class T>
constexpr T never = std::numeric_limits<T>::infinity();

TYPED_TEST(Slab, enters_where_it_should) {
  using T = TypeParam;
  const float box[2][3] = {{1, -1, -1}, {3, 1, 1}};
  EXPECT_EQ(entry<T>({{0, 0, 0}, {1, 0, 0}}, box), T(1));
  EXPECT_EQ(entry<T>({{0, 0, 0}, {2, 0, 0}}, box), T(0.5));
  EXPECT_EQ(entry<T>({{4, 0, 0}, {-1, 0, 0}}, box), T(1));
  EXPECT_EQ(entry<T>({{2, 0, 0}, {1, 0, 0}}, box), T(0));  // begins within
  EXPECT_EQ(entry<T>({{0, 0, 0}, {-1, 0, 0}}, box), never<T>);
  EXPECT_EQ(entry<T>({{0, 0, 0}, {1, 0, 0}, T(0.9)}, box), never<T>);
  EXPECT_EQ(entry<T>({{0, 0, 0}, {1, 0, 0}, T(1)}, box), T(1));
  EXPECT_EQ(entry<T>({{0, 2, 0}, {1, 0, 0}}, box), never<T>);
  EXPECT_EQ(entry<T>({{0, 2, 0}, {1, T(-0.0), 0}}, box), never<T>);
}

// A ray within the plane of a face, and the same with -0: 0 * infinity must not lose the box.
TYPED_TEST(Slab, keeps_rays_that_lie_in_a_face) {
  using T = TypeParam;
  const float box[2][3] = {{1, -1, -1}, {3, 1, 1}};
  const float flat[2][3] = {{1, 1, -1}, {3, 1, 1}};
  for (const T zero : {T(0), T(-0.0)}) {
    for (const T y : {T(-1), T(1)}) {
      EXPECT_EQ(entry<T>({{0, y, 0}, {1, zero, zero}}, box), T(1));
      EXPECT_EQ(entry<T>({{4, y, 1}, {-1, zero, zero}}, box), T(1));
    }
    EXPECT_EQ(entry<T>({{0, 1, 0}, {1, zero, zero}}, flat), T(1));
    EXPECT_EQ(entry<T>({{0, 2, 0}, {1, zero, zero}}, flat), never<T>);
    EXPECT_EQ(entry<T>({{2, 1, 0}, {zero, zero, zero}}, flat), T(0));
    EXPECT_EQ(entry<T>({{2, 2, 0}, {zero, zero, zero}}, flat), never<T>);
  }
}

// Rays aimed at points of the box, corners and edges above all, must meet it however they round:
// without the padding, hundreds of them do not.
TYPED_TEST(Slab, never_loses_a_box_by_rounding) {
  using T = TypeParam;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> within(-1, 1);
  std::uniform_int_distribution<int> choice(0, 2);
  for (int i = 0; i < 200000; ++i) {
    float box[2][3];
    Vec3<T> target, origin;
    for (int axis = 0; axis < 3; ++axis) {
      const float a = within(random), b = choice(random) == 0 ? a : within(random);
      box[0][axis] = std::min(a, b);
      box[1][axis] = std::max(a, b);
      const int where = choice(random);
      target[axis] = where < 2 ? T(box[where][axis]) : (T(a) + T(b)) / 2;
      origin[axis] = T(8) * T(within(random));
    }
    // The exact ray through origin and target: a direction that is not rounded.
    const Vec3<T> direction = target - origin;
    const Vec3<T> start = target - direction;
    if (start != origin) continue;
    EXPECT_LE(entry<T>({origin, direction}, box), T(1) + 4 * std::numeric_limits<T>::epsilon());
  }
}

}  // namespace
}  // namespace minkray
