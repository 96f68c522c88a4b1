// SPDX-License-Identifier: MIT
// Guarantees of a signed distance, judged by planes and points of the shapes' own support mappings
// in long double, which the solvers do not use.
#pragma once

#include <sstream>
#include <string>

#include "core/query/tolerances.h"
#include "tests/core/pair_distance/random_bodies.h"

namespace minkray::testing {

/// The gap between planes with normal n.
inline double gap(const Body& a, const Body& b, const Vec3<double>& n) {
  const Vec3<double> from = a.pose.translation;
  return static_cast<double>(-b.support_function(-n, from) - a.support_function(n, from));
}

/// The largest gap that a search at random finds, which begins with what is thought to be best.
inline double best_gap(const Body& a, const Body& b, const Vec3<double>& start,
                       RandomShapes& random) {
  double best_of_all = -std::numeric_limits<double>::infinity();
  for (const bool from_start : {true, false}) {
    Vec3<double> best = from_start && start.norm() > 0.5 ? start : random.direction();
    double largest = gap(a, b, best), step = from_start ? 1e-3 : 0.3;
    for (int i = 0; i < 60; ++i) {
      const bool is_anywhere = !from_start && i < 25;
      const Vec3<double> n = is_anywhere
                                 ? random.direction()
                                 : Vec3<double>((best + step * random.direction()).normalized());
      const double found = gap(a, b, n);
      if (found > largest) {
        largest = found;
        best = n;
      } else if (!is_anywhere) {
        step *= 0.75;
      }
    }
    best_of_all = std::max(best_of_all, largest);
  }
  return best_of_all;
}

/// Distance of a point outside of a body, judged by some directions.
inline double outside(const Body& body, const Vec3<double>& point, const Vec3<double>& normal,
                      RandomShapes& random) {
  double most = 0;
  for (int i = 0; i < 12; ++i) {
    Vec3<double> n = normal;
    if (i >= 8) n = random.direction();
    if (i > 0 && i < 8) n += 1e-3 * random.direction();
    most = std::max(most, static_cast<double>(-body.support_function(n, point)));
  }
  return most;
}

/// Description of an error in the result; empty if there is none.
inline std::string complaint(const Body& a, const Body& b, const SignedDistance& result,
                             RandomShapes& random) {
  const double size = size_of(a, b);
  const double reaches = size + a.ready.middle().norm() + b.ready.middle().norm() +
                         (b.pose.translation - a.pose.translation).norm();
  const double rounding = 16 * tolerance::epsilon<double> * reaches;
  // The world's own digits, in which the points are reported.
  const double far = rounding + 4 * tolerance::epsilon<double> * a.pose.translation.norm();
  std::ostringstream text;
  text.precision(17);
  const auto expect = [&](bool holds, const char* what, double by) {
    if (!holds && text.str().empty())
      text << what << " (" << by << "): value " << result.value << " in [" << result.lower << ", "
           << result.upper << "], size " << size;
  };
  expect(result.status != SignedStatus::undecided, "it is undecided", 0);
  expect(result.lower <= result.value && result.value <= result.upper, "value is out of bounds", 0);
  const double width = result.upper - result.lower;
  expect(width <= 1e-9 * size + 4 * rounding, "the bounds are far apart", width);
  // The plane proves the lower bound, and no plane is better than the upper one.
  expect(std::abs(result.normal.norm() - 1) <= 1e-14, "the normal is not of unit length",
         result.normal.norm());
  const double of_plane = gap(a, b, result.normal);
  expect(result.lower <= of_plane + rounding, "the plane is nearer than lower", of_plane);
  const double best = best_gap(a, b, result.normal, random);
  expect(result.upper >= best - rounding, "a plane is better than upper", best);
  // The points are of the shapes, and as far from each other.
  const double near = (result.status == SignedStatus::separated ? 1e-11 : 1e-8) * size + far;
  // Between planes `lower` apart, points `upper` apart are no further aside than this.
  const double aside = std::sqrt(2 * std::abs(result.value) * (width + rounding));
  const double apart = ((result.point_b - result.point_a) - result.value * result.normal).norm();
  const bool is_apart = result.status == SignedStatus::separated;
  expect(apart <= 3e-6 * size + far + (is_apart ? aside : 0),
         "the points are not value along the normal apart", apart);
  const double of_a = outside(a, result.point_a, result.normal, random),
               of_b = outside(b, result.point_b, -result.normal, random);
  expect(of_a <= near, "point_a is outside of A", of_a);
  expect(of_b <= near, "point_b is outside of B", of_b);
  return text.str();
}

/// B moves to where the two touch, or nearly: `left` apart in sizes, if negative they overlap.
inline void bring_near(const Body& a, Body& b, double left, double size) {
  const SignedDistance first = signed_distance(a, b);
  b.pose.translation -= (first.value - left * size) * first.normal;
}

/// The k-th of a family of pairs: apart, overlapping, touching and nearly so, of all scales, far
/// from the origin, one in the other.
struct RandomPair {
  Body a, b;
};
inline RandomPair random_pair(int i, int j, int k, RandomShapes& random) {
  const double scale = k % 6 == 5 ? std::pow(10, random.in(-3, 3)) : 1;
  const double other = k % 8 == 7 ? scale * std::pow(10, random.in(-2, 2)) : scale;
  const Vec3<double> origin =
      k % 5 == 4 ? 1e4 * scale * random.direction() : Vec3<double>(Vec3<double>::Zero());
  RandomPair pair{Body(random_shape(i, scale, random), {random.turn(), origin}),
                  Body(random_shape(j, other, random), {random.turn(), origin})};
  Body& b = pair.b;
  const double size = size_of(pair.a, b) + scale;
  b.pose.translation += random.in(0, 1.3) * size * random.direction();
  if (k % 3 == 2) {
    const double left = k % 2 == 0 ? 0 : std::pow(10, random.in(-14, -3));
    bring_near(pair.a, b, k % 4 < 2 ? left : -left, size);
  }
  return pair;
}

/// The k-th pair of slender shapes: apart or overlapping, touching, nearly so.
inline RandomPair slender_pair(int k, double thin, RandomShapes& random) {
  RandomPair pair{
      Body(slender_shape(thin, random), {random.turn(), Vec3<double>::Zero()}),
      Body(slender_shape(thin, random), {random.turn(), random.in(0, 2.5) * random.direction()})};
  const double size = size_of(pair.a, pair.b);
  const double left = k % 3 == 1 ? 0 : std::pow(10, random.in(-14, -3));
  if (k % 3 > 0) bring_near(pair.a, pair.b, k % 2 == 0 ? left : -left, size);
  return pair;
}

}  // namespace minkray::testing
