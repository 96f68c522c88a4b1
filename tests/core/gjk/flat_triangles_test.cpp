// SPDX-License-Identifier: MIT
// The point nearest to the origin of triangles that are nearly or altogether flat.
#include <gtest/gtest.h>

#include "core/gjk/closest_point.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

using testing::Random;
__extension__ using Quad = __float128;
using QuadPoint = std::array<Quad, 3>;

Quad dot(const QuadPoint& a, const QuadPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
QuadPoint plus(const QuadPoint& a, const QuadPoint& b, Quad times) {
  return {a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]};
}

QuadPoint nearest_of_edge(const QuadPoint& a, const QuadPoint& b) {
  const QuadPoint e = plus(b, a, -1);
  const Quad squared = dot(e, e);
  if (!(squared > 0)) return a;
  const Quad k = -dot(a, e) / squared;
  return plus(a, e, k < 0 ? Quad(0) : k > 1 ? Quad(1) : k);
}

/// In 113 bits, by the edges and the foot on the face.
QuadPoint nearest_of_triangle(const QuadPoint& a, const QuadPoint& b, const QuadPoint& c) {
  QuadPoint best = nearest_of_edge(a, b);
  for (const QuadPoint& other : {nearest_of_edge(b, c), nearest_of_edge(c, a)})
    if (dot(other, other) < dot(best, best)) best = other;
  const QuadPoint e = plus(b, a, -1), f = plus(c, a, -1);
  const Quad ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), ea = -dot(e, a), fa = -dot(f, a);
  const Quad determinant = ee * ff - ef * ef;
  if (!(determinant > 0)) return best;
  const Quad u = (ff * ea - ef * fa) / determinant, w = (ee * fa - ef * ea) / determinant;
  if (u < 0 || w < 0 || u + w > 1) return best;
  return plus(plus(a, e, u), f, w);
}

/// Returns the error of the point that was found, by the distance: the worst of slivers with such
/// sines, whose corners are numbers of T, below the origin.
double worst_error(double least_power, double most_power) {
  Random random(29);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vec3<double> along = random.direction(),
                       across = unit<double>(along.cross(random.direction())),
                       up = along.cross(across) * std::exp2(random.uniform(-8, 1));
    const double sine = std::exp2(random.uniform(least_power, most_power));
    const double foot = random.uniform(0.3, 0.7), top = random.uniform(0.3, 0.7);
    const Vec3<double> from = up - foot * along - sine * random.uniform(0, 0.5) * across;
    const std::array<Vec3<double>, 3> y = {
        from.cast<double>(), Vec3<double>(from + along).cast<double>(),
        Vec3<double>(from + top * along + sine * across).cast<double>()};
    SimplexPoints<double> simplex;
    simplex.y[0] = y[0], simplex.y[1] = y[1], simplex.y[2] = y[2];
    simplex.size = 3;
    const Vec3<double> v = closest_point(simplex).v;
    std::array<QuadPoint, 3> exact;
    for (std::size_t k = 0; k < 3; ++k) exact[k] = {Quad(y[k][0]), Quad(y[k][1]), Quad(y[k][2])};
    const QuadPoint nearest = nearest_of_triangle(exact[0], exact[1], exact[2]);
    const QuadPoint found = {Quad(v[0]), Quad(v[1]), Quad(v[2])};
    const QuadPoint off = plus(found, nearest, -1);
    worst = std::max(worst, std::sqrt(static_cast<double>(dot(off, off) / dot(nearest, nearest))));
  }
  return worst;
}

/// The normal of three points in a line is rounding's, and the foot along it is anywhere.
TEST(FlatTriangles, that_rounding_cannot_tell_from_an_edge_are_answered_by_it) {
  EXPECT_LT(worst_error(-55, -53), 1e-12);
}

}  // namespace
}  // namespace minkray
