// SPDX-License-Identifier: MIT
// Compares shape casts of balls, boxes and capsules with closed forms.
#include <gtest/gtest.h>

#include <optional>

#include "tests/renderer/paper/random_poses.h"

namespace minkray {
namespace {

using V = Vec3<double>;
using testing::at;
using testing::pair_of;
using testing::RandomPoses;

// Closed forms. Each is the first t >= 0 at which the point o + t d is in the obstacle.

std::optional<double> first_root(double a, double half_b, double c) {
  const double discriminant = half_b * half_b - a * c;
  if (discriminant < 0 || a == 0) return std::nullopt;
  const double q = half_b + std::copysign(std::sqrt(discriminant), half_b);
  return std::min(-q / a, -c / q);
}

std::optional<double> ball_entry(const V& o, const V& d, double radius) {
  if (o.norm() <= radius) return 0.0;
  const auto t = first_root(d.squaredNorm(), o.dot(d), o.squaredNorm() - radius * radius);
  return t && *t >= 0 ? t : std::nullopt;
}

std::optional<double> box_entry(const V& o, const V& d, const V& h) {
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (d[i] == 0) {
      if (std::abs(o[i]) > h[i]) return std::nullopt;
      continue;
    }
    const double s = std::copysign(1.0, d[i]);
    enter = std::max(enter, (-s * h[i] - o[i]) / d[i]);
    leave = std::min(leave, (s * h[i] - o[i]) / d[i]);
  }
  return enter <= leave ? std::optional(enter) : std::nullopt;
}

/// The box grown by a ball is the union of three boxes, twelve cylinders and eight balls; one of
/// convex parts whose union is convex: the first entry into any.
std::optional<double> rounded_box_entry(const V& o, const V& d, const V& h, double radius) {
  std::optional<double> first;
  const auto consider = [&](std::optional<double> t) {
    if (t && (!first || *t < *first)) first = t;
  };
  for (int axis = 0; axis < 3; ++axis) {
    V grown = h;
    grown[axis] += radius;
    consider(box_entry(o, d, grown));
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    for (const double su : {-1.0, 1.0})
      for (const double sw : {-1.0, 1.0}) {
        V centre = V::Zero();
        centre[u] = su * h[u];
        centre[w] = sw * h[w];
        V across_o = o - centre, across_d = d;
        const double along = across_o[axis];
        across_o[axis] = across_d[axis] = 0;
        if (across_o.norm() <= radius && std::abs(along) <= h[axis]) return 0.0;
        if (const auto t = first_root(across_d.squaredNorm(), across_o.dot(across_d),
                                      across_o.squaredNorm() - radius * radius);
            t && *t >= 0 && std::abs(along + *t * d[axis]) <= h[axis])
          consider(t);
        for (const double sa : {-1.0, 1.0}) {
          centre[axis] = sa * h[axis];
          consider(ball_entry(o - centre, d, radius));
        }
      }
  }
  return first;
}

void expect_entry(const ShapeCastResult& result, std::optional<double> expected, double tolerance,
                  int i) {
  if (!expected) {
    EXPECT_EQ(result.cast.status, Status::miss) << i;
    return;
  }
  ASSERT_TRUE(result.cast.found()) << i << " " << name_of(result.cast.status);
  EXPECT_EQ(result.cast.status == Status::inside, *expected == 0) << i;
  EXPECT_NEAR(result.cast.t(), *expected, tolerance) << i;
  EXPECT_LT((result.point_a - result.point_b).norm(), 1e-12) << i;
}

/// Loss of precision of t compared with the position: grazing contacts slide along.
double slope(const ShapeCastResult& result, const V& d) {
  return 1 / std::max(std::abs(result.cast.normal.dot(d)), 1e-3);
}

TEST(ShapeCast, of_balls_boxes_and_capsules_has_its_closed_form) {
  RandomPoses random(1);
  int hits = 0, casts = 0;
  for (int i = 0; i < 500; ++i) {
    const V h = random.in_cube(1).cwiseAbs() + V::Constant(0.05);
    const V g = random.in_cube(1).cwiseAbs() + V::Constant(0.05);
    const V a = random.in_cube(4), b = random.in_cube(4);
    const V d = (a - b) + random.in_cube(2.5);
    const double r = random.in(0.1, 1), q = random.in(0.1, 1);
    const V o = b - a;
    const auto check = [&](const Shape& A, const Shape& B, std::optional<double> expected) {
      const auto pair = pair_of(A, at(a), B, at(b));
      const auto result = cast_shape(pair, d, 10);
      if (expected && *expected > 10) expected.reset();
      expect_entry(result, expected, 1e-13 * slope(result, d), i);
      hits += result.cast.found();
      ++casts;
    };
    check(Sphere{r}, Sphere{q}, ball_entry(o, d, r + q));
    check(Box{h}, Box{g}, box_entry(o, d, h + g));
    check(Box{h}, Sphere{q}, rounded_box_entry(o, d, h, q));
    check(Sphere{q}, Box{h}, rounded_box_entry(o, d, h, q));
    check(Capsule{r, h.z()}, Sphere{q}, rounded_box_entry(o, d, V(0, 0, h.z()), r + q));
  }
  EXPECT_GT(hits, casts * 3 / 10);
  EXPECT_LT(hits, casts * 7 / 10);
}

}  // namespace
}  // namespace minkray
