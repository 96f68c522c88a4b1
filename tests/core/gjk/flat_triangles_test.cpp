// SPDX-License-Identifier: MIT
// The point nearest to the origin of triangles that are nearly or altogether flat.
#include <gtest/gtest.h>

#include "core/gjk/closest_point.h"
#include "tests/oracle/quad.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

using testing::Quad;
using testing::QuadVec;
using testing::Random;

QuadVec nearest_of_edge(const QuadVec& a, const QuadVec& b) {
  const QuadVec e = b - a;
  if (!(e.squaredNorm() > 0)) return a;
  const Quad k = -a.dot(e) / e.squaredNorm();
  return a + (k < 0 ? Quad(0) : k > 1 ? Quad(1) : k) * e;
}

/// In 113 bits, by the edges and the foot on the face.
QuadVec nearest_of_triangle(const QuadVec& a, const QuadVec& b, const QuadVec& c) {
  QuadVec best = nearest_of_edge(a, b);
  for (const QuadVec& other : {nearest_of_edge(b, c), nearest_of_edge(c, a)})
    if (other.squaredNorm() < best.squaredNorm()) best = other;
  const QuadVec e = b - a, f = c - a;
  const Quad ee = e.dot(e), ef = e.dot(f), ff = f.dot(f), ea = -e.dot(a), fa = -f.dot(a);
  const Quad determinant = ee * ff - ef * ef;
  if (!(determinant > 0)) return best;
  const Quad u = (ff * ea - ef * fa) / determinant, w = (ee * fa - ef * ea) / determinant;
  if (u < 0 || w < 0 || u + w > 1) return best;
  return a + u * e + w * f;
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
    const SimplexPoints<double> y = {from, Vec3<double>(from + along),
                                     Vec3<double>(from + top * along + sine * across)};
    const Vec3<double> v = closest_point(y, 0b111).v;
    const QuadVec nearest =
        nearest_of_triangle(testing::quad(y[0]), testing::quad(y[1]), testing::quad(y[2]));
    const Quad off = (testing::quad(v) - nearest).squaredNorm() / nearest.squaredNorm();
    worst = std::max(worst, std::sqrt(static_cast<double>(off)));
  }
  return worst;
}

/// The normal of three points in a line is rounding's, and the foot along it is anywhere.
TEST(FlatTriangles, that_rounding_cannot_tell_from_an_edge_are_answered_by_it) {
  EXPECT_LT(worst_error(-55, -53), 1e-12);
}

}  // namespace
}  // namespace minkray
