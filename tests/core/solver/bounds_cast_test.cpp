// SPDX-License-Identifier: MIT
// What a shape's bounds tell of a cast, against the slabs of the box in long double.
#include <gtest/gtest.h>

#include "core/shape/convert.h"
#include "core/shape/shape_bounds.h"
#include "core/solver/cast.h"
#include "core/solver/model_cast.h"
#include "tests/support/random.h"
#include "tests/support/rounded.h"

namespace minkray::testing {
namespace {

using Long = long double;

/// How much a box may shrink (less than 0: must grow), as a part of its size, for the line still to
/// meet it: the ordinary test by slabs, and bisection.
double room(const Vec3<double>& half_extents, const Vec3<Long>& o, const Vec3<Long>& d) {
  const auto meets = [&](Long size) {
    Long first = -std::numeric_limits<Long>::infinity(), last = -first;
    for (int k = 0; k < 3; ++k) {
      const Long h = size * half_extents[k];
      if (d[k] == 0) {
        if (std::abs(o[k]) > h) return false;
        continue;
      }
      const Long a = (-h - o[k]) / d[k], b = (h - o[k]) / d[k];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    return first <= last;
  };
  Long low = 0, high = 4;
  for (int i = 0; i < 80; ++i) {
    const Long middle = (low + high) / 2;
    (meets(middle) ? high : low) = middle;
  }
  return static_cast<double>(1 - high);
}

template <class T>
void check_against_slabs() {
  Random random(71);
  int open = 0, passes = 0;
  for (int i = 0; i < 20000; ++i) {
    Vec3<double> half_extents(1, random.uniform(0.01, 1), random.uniform(0.01, 1));
    half_extents = half_extents.cast<T>().template cast<double>();
    const Vec3<T> h = half_extents.cast<T>();
    const Ball<T> ball = ball_around(Bounds<T>{-h, h});
    Vec3<double> d = random.direction();
    if (i % 5 == 0) d[random.below(3)] = 0;
    if (i % 25 == 0) d = Vec3<double>::Unit(random.below(3));
    const Vec3<double> o = random.in_cube() - d * 4;
    const Ray<T> ray{o.cast<T>(), d.cast<T>()};
    const RayNearBall<T> near = ray_near<T>(ball.centre, ray);
    const BoundsCast<T> bounds = cast_at_bounds<T>(near, ball, h, true);
    ASSERT_NE(bounds.open, bounds.miss);
    const Ray<double> known = in_double(ray);
    const double left = room(half_extents, known.origin.template cast<Long>(),
                             known.direction.template cast<Long>());
    // A line of this distance may be told either way: rounding, relative to the thinnest side.
    const double rounding = 100 * std::numeric_limits<T>::epsilon() / half_extents.minCoeff();
    open += bounds.open;
    passes += bounds.miss;
    if (left > 0) {
      ASSERT_TRUE(bounds.open) << left;
    } else if (left < -rounding) {
      ASSERT_TRUE(bounds.miss) << left;
    }
    if (bounds.open) continue;
    // A plane between the line and the box.
    const Vec3<double> n = bounds.normal.template cast<double>();
    EXPECT_NEAR(n.norm(), 1, 8 * std::numeric_limits<T>::epsilon());
    const double reach = n.cwiseAbs().dot(half_extents);
    const Vec3<double> s = near.s.template cast<double>(), r = near.r.template cast<double>();
    EXPECT_GT(n.dot(s), reach);
    EXPECT_LE(std::abs(n.dot(r)), 8 * std::numeric_limits<T>::epsilon());
  }
  EXPECT_GT(open, 2000);
  EXPECT_GT(passes, 2000);
}

TEST(BoundsCast, tells_lines_that_pass_by_the_box) {
  check_against_slabs<double>();
  check_against_slabs<float>();
}

TEST(BoundsCast, tells_rays_that_end_before_the_ball_or_begin_behind_it) {
  const Vec3<double> h(1, 0.5, 0.25);
  const Ball<double> ball = ball_around(Bounds<double>{-h, h});
  const auto of = [&](const Ray<double>& ray) {
    return cast_at_bounds<double>(ray_near<double>(ball.centre, ray), ball, h, true);
  };
  const Vec3<double> x = Vec3<double>::UnitX();
  EXPECT_TRUE(of({-4 * x, x}).open);
  EXPECT_TRUE(of({-4 * x, x, 2}).miss);
  EXPECT_TRUE(of({4 * x, x}).miss);
  EXPECT_NEAR((of({-4 * x, x, 2}).normal + x).norm(), 0, 1e-15);
  EXPECT_NEAR((of({4 * x, x}).normal - x).norm(), 0, 1e-15);
  EXPECT_FALSE(of({-4 * x, Vec3<double>::Zero()}).open);
}

TEST(BoundsCast, spares_the_shape_itself) {
  const PreparedShape<float> needle(
      convert<float>(Shape<double>(Ellipsoid<double>{{1, 0.03, 0.001}})));
  Random random(73);
  int asked = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3<double> at = random.in_cube(), d = random.direction();
    const CastResult<float> result =
        cast_ray(needle, Ray<float>{(at - 4 * d).cast<float>(), d.cast<float>()});
    asked += result.supports > 0;
  }
  EXPECT_LT(asked, 200);
}

}  // namespace
}  // namespace minkray::testing
