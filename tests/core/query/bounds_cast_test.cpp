// SPDX-License-Identifier: MIT
// Compares casts at a shape's bounds with the slabs of the box in long double.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "core/derived/shape_bounds.h"
#include "core/query/bounds_cast.h"
#include "tests/support/random.h"
#include "tests/support/shifted.h"

namespace minkray::testing {
namespace {

using Long = long double;

/// Factor by which a box may shrink (less than 0: must grow), as a part of its size, for the line
/// still to meet it: the ordinary test by slabs, and bisection.
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

/// A box somewhere, as a mapped shape: any will do, only its bounds are used.
struct MappedBox {
  Vec3<double> half_extents;
  Affine<double> pose;
  PreparedShape prepared;

  MappedBox(const Vec3<double>& h, const Affine<double>& map)
      : half_extents(h.cast<double>().cast<double>()),
        pose{map.linear.cast<double>().cast<double>(),
             map.translation.cast<double>().cast<double>()},
        prepared(Shape(Box{h.cast<double>()}),
                 Affine<double>{map.linear.cast<double>(), map.translation.cast<double>()}) {}

  BoundsCast<double> cast(const Ray<double>& ray) const {
    return cast_at_box(prepared.line_to_inner(ray), prepared.inner_half_extents(),
                       prepared.inner_ball().radius, true);
  }
};

/// Rays about a box that meet it or pass it by, origins `distance` away.
void check_against_slabs(const Affine<double>& map, double distance) {
  Random random(71);
  int open = 0, passes = 0;
  for (int i = 0; i < 5000; ++i) {
    const MappedBox box({1, random.uniform(0.01, 1), random.uniform(0.01, 1)}, map);
    Vec3<double> d = random.direction();
    if (i % 5 == 0) d[random.below(3)] = 0;
    if (i % 25 == 0) d = Vec3<double>::Unit(random.below(3));
    d *= std::pow(10.0, random.uniform(-9, 9));
    const Vec3<double> o = random.in_cube() - d.normalized() * distance;
    const Ray<double> ray{map(o).cast<double>(), Vec3<double>(map.linear * d).cast<double>()};
    const BoundsCast<double> bounds = box.cast(ray);
    ASSERT_NE(bounds.open, bounds.miss);
    const Mat3<Long> back = box.pose.linear.cast<Long>().inverse();
    const Vec3<Long> from = back * (ray.origin - box.pose.translation).cast<Long>();
    const Vec3<Long> along = (back * ray.direction.cast<Long>()).normalized();
    const double left = room(box.half_extents, from, along);
    // A line so near may get either result: rounding, as a part of the thinnest side.
    const double rounding = 200 * std::numeric_limits<double>::epsilon() * distance /
                            box.half_extents.minCoeff() / std::abs(map.linear.determinant());
    open += bounds.open;
    passes += bounds.miss;
    if (left > 0) {
      ASSERT_TRUE(bounds.open) << left;
    } else if (left < -rounding) {
      ASSERT_TRUE(bounds.miss) << left << ", " << rounding;
    }
    if (bounds.open) continue;
    // A plane between the line and the box.
    const Vec3<double> n = bounds.normal.cast<double>();
    EXPECT_NEAR(n.norm(), 1, 8 * std::numeric_limits<double>::epsilon());
    const Vec3<double> r = along.cast<double>();
    const Vec3<double> s = (from - along * from.dot(along)).cast<double>();
    EXPECT_GT(n.dot(s), n.cwiseAbs().dot(box.half_extents));
    EXPECT_LE(std::abs(n.dot(r)), 64 * std::numeric_limits<double>::epsilon());
  }
  EXPECT_GT(open, 500);
  EXPECT_GT(passes, 500);
}

const Affine<double> as_it_is{shifted_by(0, 0, 0)};

TEST(BoundsCast, tells_lines_that_pass_by_the_box) {
  check_against_slabs(as_it_is, 4);
}

TEST(BoundsCast, is_never_wrong_from_afar) {
  check_against_slabs(as_it_is, 1e5);
}

TEST(BoundsCast, tells_them_under_a_map) {
  Mat3<double> sheared;
  sheared << 1, 0.5, 0, -0.3, 0.8, 0.2, 0, 0.4, 1.5;
  check_against_slabs({sheared, {3, -2, 5}}, 4);
}

/// Lines through points of the box's edges that just touch it, or miss by rounding.
void check_edges(const Affine<double>& map) {
  Random random(79);
  int touch = 0;
  for (int i = 0; i < 20000; ++i) {
    const MappedBox box({1, random.uniform(0.01, 1), random.uniform(0.01, 1)}, map);
    const int along_edge = random.below(3);
    Vec3<double> at = box.half_extents;
    at[along_edge] *= random.uniform(-1, 1);
    Vec3<double> outward(random.uniform(), random.uniform(), random.uniform());
    outward[along_edge] = 0;
    const Vec3<double> d = outward.cross(random.direction());
    const Vec3<double> o = at - d.normalized() * random.uniform(1, 4);
    const Ray<double> ray{map(o).cast<double>(), Vec3<double>(map.linear * d).cast<double>()};
    const Mat3<Long> back = box.pose.linear.cast<Long>().inverse();
    const double left =
        room(box.half_extents, back * (ray.origin - box.pose.translation).cast<Long>(),
             (back * ray.direction.cast<Long>()).normalized());
    if (left < 0) continue;
    ++touch;
    ASSERT_TRUE(box.cast(ray).open) << i << ": " << left;
  }
  EXPECT_GT(touch, 5000);
}

TEST(BoundsCast, leaves_lines_that_touch_an_edge) {
  check_edges(as_it_is);
  Mat3<double> turned = Random(81).rotation();
  turned.col(2) *= 0.2;
  check_edges({turned, {0.1, 0.2, 0.3}});
}

/// Far from its own origin a shape's centre is rounded coarsely.
TEST(BoundsCast, holds_shapes_that_are_off_their_own_origin) {
  for (const double low : {16.0, 100.0, 1000.0, 1e5}) {
    const double ulp = std::nextafter(low, 2 * low) - low, high = low + 16385 * ulp;
    const Shape shape = Triangle{
        {Vec3<double>(low, low, low), Vec3<double>(high, low, low), Vec3<double>(high, high, low)}};
    const PreparedShape prepared(shape);
    const Ray<double> ray{{high, (low + high) / 2, low + 10}, {0, 0, -1}};
    EXPECT_NE(cast_ray(prepared, ray).status, Status::miss) << low;
  }
}

TEST(BoundsCast, leaves_what_it_cannot_tell) {
  const MappedBox box({1, 0.5, 0.25}, as_it_is);
  const Vec3<double> past(0, 2, 0), x = Vec3<double>::UnitX();
  EXPECT_TRUE(box.cast({past, x}).miss);
  EXPECT_TRUE(box.cast({past, Vec3<double>::Zero()}).open);
  EXPECT_TRUE(box.cast({past, x * 1e-308}).open) << "digits are lost";
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(box.cast({past, x * infinity}).open);
  EXPECT_TRUE(box.cast({past * infinity, x}).open);
  EXPECT_TRUE(box.cast({past * 1e250, x * 1e250}).open) << "overflows";
  const double nan = std::nan("");
  EXPECT_TRUE(box.cast({{nan, 2, 0}, x}).open);
  EXPECT_TRUE(box.cast({{0, nan, 2}, x}).open);
  EXPECT_TRUE(box.cast({{0, 2, nan}, x}).open);
  const MappedBox cube({1, 1, 1}, as_it_is);
  EXPECT_TRUE(cube.cast({{0, -356.57901, -183.640625}, {0, 9.7921e305, 5.0375e305}}).open)
      << "one product overflows, the other does not";
}

TEST(BoundsCast, tells_rays_that_end_before_the_ball_or_begin_behind_it) {
  const Vec3<double> h(1, 0.5, 0.25);
  const Ball<double> ball = ball_around(Bounds<double>{-h, h});
  const auto of = [&](const Ray<double>& ray) {
    BoundsCast<double> bounds{true, false, Vec3<double>::Zero()};
    cast_at_ball(ray_near<double>(ball.centre, ray), ball.radius, bounds);
    return bounds;
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
  const PreparedShape needle(Shape(Ellipsoid{{1, 0.03, 0.001}}));
  Random random(73);
  int asked = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3<double> at = random.in_cube(), d = random.direction();
    const CastResult<double> result = cast_ray(needle, Ray<double>{at - 4 * d, d});
    asked += result.supports > 0;
  }
  EXPECT_LT(asked, 200);
}

}  // namespace
}  // namespace minkray::testing
