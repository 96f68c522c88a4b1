// SPDX-License-Identifier: MIT
// Boxes that maps within maps turn into needles, blades and plates, down to 10^-12 of their
// length: their distances from balls are within the bounds, and no status is false. Turning a box,
// scaling it and turning it again loses digits that the thin sides need. Judged in quadruple
// precision by all faces, edges and corners of the box's image.
#include <gtest/gtest.h>

#include "core/pair_distance/signed_distance.h"
#include "tests/core/pair_distance/random_numbers.h"
#include "tests/support/number_of_cases.h"

namespace minkray::testing {
namespace {

__extension__ using Quad = __float128;
using QuadVec = std::array<Quad, 3>;
using QuadMat = std::array<QuadVec, 3>;  ///< columns

Quad root(Quad x) {
  if (!(x > 0)) return 0;
  int exponent = 0;
  std::frexp(static_cast<long double>(x), &exponent);
  exponent -= exponent & 1;
  const Quad scaled = x * Quad(std::ldexp(1.0L, -exponent));
  Quad r = std::sqrt(static_cast<long double>(scaled));
  for (int i = 0; i < 2; ++i) r = (r + scaled / r) / 2;
  return r * Quad(std::ldexp(1.0L, exponent / 2));
}
Quad dot(const QuadVec& a, const QuadVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
QuadVec plus(const QuadVec& a, const QuadVec& b, Quad t) {
  return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
}
QuadMat times(const Mat3<double>& m, const QuadMat& columns) {
  QuadMat product{};
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        product[j][i] += Quad(m(static_cast<int>(i), static_cast<int>(k))) * columns[j][k];
  return product;
}

/// The point of the flat that `free` sides span, nearest to p: its parameters along them. By
/// Gram-Schmidt, twice over: the sides may be as good as parallel.
bool solve(const QuadMat& sides, const std::vector<std::size_t>& free, const QuadVec& p,
           QuadVec& t) {
  std::vector<QuadVec> axes;
  std::array<std::array<Quad, 3>, 3> upper{};
  for (std::size_t j = 0; j < free.size(); ++j) {
    QuadVec v = sides[free[j]];
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t i = 0; i < axes.size(); ++i) {
        const Quad along = dot(axes[i], v);
        upper[i][j] += along;
        v = plus(v, axes[i], -along);
      }
    const Quad length = root(dot(v, v));
    if (!(length > 0)) return false;
    upper[j][j] = length;
    axes.push_back({v[0] / length, v[1] / length, v[2] / length});
  }
  for (std::size_t j = free.size(); j-- > 0;) {
    Quad rest = dot(axes[j], p);
    for (std::size_t k = j + 1; k < free.size(); ++k) rest -= upper[j][k] * t[free[k]];
    t[free[j]] = rest / upper[j][j];
  }
  return true;
}

/// The signed distance of a point from all sums of sides times numbers from -1 to 1.
Quad distance_to_box(const QuadMat& sides, const QuadVec& p) {
  Quad least = -1;
  bool is_inside = false;
  for (int active = 0; active < 27; ++active) {
    QuadVec t{}, rest = p;
    std::vector<std::size_t> free;
    int digits = active;
    for (std::size_t j = 0; j < 3; ++j, digits /= 3) {
      if (digits % 3 == 0) free.push_back(j);
      t[j] = digits % 3 - (digits % 3 == 2 ? 3 : 0);
      rest = plus(rest, sides[j], -t[j]);
    }
    if (!solve(sides, free, rest, t)) continue;
    QuadVec apart = p;
    bool is_within = true;
    for (std::size_t j = 0; j < 3; ++j) {
      is_within &= t[j] >= -1 && t[j] <= 1;
      apart = plus(apart, sides[j], -t[j]);
    }
    if (!is_within) continue;
    is_inside |= free.size() == 3;
    const Quad squared = dot(apart, apart);
    if (least < 0 || squared < least) least = squared;
  }
  if (!is_inside) return root(least);
  Quad depth = -1;
  for (std::size_t j = 0; j < 3; ++j) {
    // Along the normal of two sides.
    const QuadVec &u = sides[(j + 1) % 3], &v = sides[(j + 2) % 3];
    const QuadVec n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                       u[0] * v[1] - u[1] * v[0]};
    const Quad length = root(dot(n, n)), at = dot(n, p) / length, reach = dot(n, sides[j]) / length;
    const Quad below = (reach < 0 ? -reach : reach) - (at < 0 ? -at : at);
    if (depth < 0 || below < depth) depth = below;
  }
  return -depth;
}

TEST(MappedNeedles, are_as_far_from_balls_as_their_faces_edges_and_corners) {
  RandomNumbers random(631);
  int settled = 0, needles = 0;
  for (int k = 0; k < number_of_cases(12000); ++k) {
    const double thin = std::pow(10, -random.in(0, 12)), between = k % 3 == 0   ? 1
                                                                   : k % 3 == 1 ? thin
                                                                                : std::sqrt(thin);
    const Vec3<double> scale(1, between, thin),
        half(random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1));
    // Sometimes the box is long itself, and the maps make it as good as round again.
    const Vec3<double> of_box = k % 4 == 0 ? Vec3<double>(half.cwiseQuotient(scale)) : half;
    const Mat3<double> first = random.turn(), second = k % 4 == 0 && k % 8 == 0
                                                           ? Mat3<double>(Mat3<double>::Identity())
                                                           : random.turn();
    const auto under = [](const Mat3<double>& linear, const Shape& shape) {
      return Shape(Transform{shape, Affine<double>{linear, Vec3<double>::Zero()}});
    };
    const Mat3<double> scales = scale.asDiagonal();
    const Shape box = Box{of_box};
    const Shape needle = under(first, under(scales, under(second, box)));
    QuadMat sides{};
    for (std::size_t j = 0; j < 3; ++j) sides[j][j] = of_box[static_cast<int>(j)];
    sides = times(first, times(scales, times(second, sides)));
    const ContactShape ready(needle);
    const double size = ready.ball_radius();
    const Vec3<double> middle = random.in(0, 2) * size * random.direction();
    const Quad gap = distance_to_box(sides, {middle.x(), middle.y(), middle.z()});
    double radius = random.in(0.01, 0.5) * size;
    if (k % 2 == 0 && gap > 0)
      radius =
          static_cast<double>(gap) + size * (k % 6 == 0   ? 0
                                             : k % 6 == 2 ? std::pow(10, random.in(-17, -12))
                                                          : -std::pow(10, random.in(-17, -12)));
    if (!(radius > 0)) continue;
    const Quad truth = gap - Quad(radius);
    ++needles;
    const SignedDistance found =
        signed_distance(ready, {}, ContactShape(Shape(Sphere{radius})), {random.turn(), middle});
    ASSERT_LE(found.lower, truth) << k << " " << thin << " " << name_of(found.status);
    ASSERT_GE(found.upper, truth) << k << " " << thin << " " << name_of(found.status);
    if (found.status == SignedStatus::separated) {
      ASSERT_GT(truth, 0) << k << " " << thin;
    }
    if (found.status == SignedStatus::overlapping) {
      ASSERT_LT(truth, 0) << k << " " << thin;
    }
    settled += found.status == SignedStatus::separated || found.status == SignedStatus::overlapping;
  }
  EXPECT_GT(needles, 9000);
  EXPECT_GT(settled, 6000);
}

}  // namespace
}  // namespace minkray::testing
