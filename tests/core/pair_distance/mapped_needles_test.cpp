// SPDX-License-Identifier: MIT
// Boxes that maps within maps turn into needles, blades and plates, down to 10^-12 of their
// length: their distances from balls are within the bounds, and no status is false. Turning a box,
// scaling it and turning it again loses digits that the thin sides need. Judged in quadruple
// precision by all faces, edges and corners of the box's image.
#include <gtest/gtest.h>

#include "core/pair_distance/signed_distance.h"
#include "tests/core/pair_distance/places.h"
#include "tests/oracle/quad.h"
#include "tests/support/number_of_cases.h"

namespace minkray::testing {
namespace {

/// The point of the flat that `free` sides (columns) span, nearest to p: its parameters along
/// them. By Gram-Schmidt, twice over: the sides may be as good as parallel.
bool solve(const QuadMat& sides, const std::vector<int>& free, const QuadVec& p, QuadVec& t) {
  std::vector<QuadVec> axes;
  QuadMat upper = QuadMat::Zero();
  const int count = static_cast<int>(free.size());
  for (int j = 0; j < count; ++j) {
    QuadVec v = sides.col(free[std::size_t(j)]);
    for (int pass = 0; pass < 2; ++pass)
      for (int i = 0; i < j; ++i) {
        const Quad along = axes[std::size_t(i)].dot(v);
        upper(i, j) += along;
        v -= along * axes[std::size_t(i)];
      }
    const Quad length = root(v.squaredNorm());
    if (!(length > 0)) return false;
    upper(j, j) = length;
    axes.push_back(v / length);
  }
  for (int j = count; j-- > 0;) {
    Quad rest = axes[std::size_t(j)].dot(p);
    for (int k = j + 1; k < count; ++k) rest -= upper(j, k) * t[free[std::size_t(k)]];
    t[free[std::size_t(j)]] = rest / upper(j, j);
  }
  return true;
}

/// The signed distance of a point from all sums of sides times numbers from -1 to 1.
Quad distance_to_box(const QuadMat& sides, const QuadVec& p) {
  Quad least = -1;
  bool is_inside = false;
  for (int active = 0; active < 27; ++active) {
    QuadVec t;
    std::vector<int> free;
    int digits = active;
    for (int j = 0; j < 3; ++j, digits /= 3) {
      if (digits % 3 == 0) free.push_back(j);
      t[j] = digits % 3 - (digits % 3 == 2 ? 3 : 0);
    }
    if (!solve(sides, free, p - sides * t, t)) continue;
    if (!(size_of(t[0]) <= 1 && size_of(t[1]) <= 1 && size_of(t[2]) <= 1)) continue;
    is_inside |= free.size() == 3;
    const Quad squared = (p - sides * t).squaredNorm();
    if (least < 0 || squared < least) least = squared;
  }
  if (!is_inside) return root(least);
  Quad depth = -1;
  for (int j = 0; j < 3; ++j) {
    // Along the normal of two sides.
    const QuadVec u = sides.col((j + 1) % 3), v = sides.col((j + 2) % 3), n = u.cross(v);
    const Quad below = (size_of(n.dot(sides.col(j))) - size_of(n.dot(p))) / root(n.squaredNorm());
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
    const QuadMat sides = first.cast<Quad>() *
                          (scales.cast<Quad>() *
                           (second.cast<Quad>() * Mat3<double>(of_box.asDiagonal()).cast<Quad>()));
    const ContactShape ready(needle);
    const double size = ready.ball_radius();
    const Vec3<double> middle = random.in(0, 2) * size * random.direction();
    const Quad gap = distance_to_box(sides, quad(middle));
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
    ASSERT_EQ(complaint_of(found, truth), "") << k << " " << thin;
    settled += found.status == SignedStatus::separated || found.status == SignedStatus::overlapping;
  }
  EXPECT_GT(needles, 9000);
  EXPECT_GT(settled, 6000);
}

}  // namespace
}  // namespace minkray::testing
