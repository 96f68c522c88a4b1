// SPDX-License-Identifier: MIT
// Casts compared with truths in long double that need neither a solver nor support points.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/cast/cast.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {

/// True relation of a line to a shape.
struct CastTruth {
  bool hit;
  /// Distance by which the line would have to be moved to just touch, at most: negative inside.
  double beside;
  long double t;
  Vec3<long double> normal;  ///< of unit length
};

/// Finds where is_before, true first and false then, changes between low and high.
long double bisected(long double low, long double high, const auto& is_before) {
  for (int i = 0; i < 200; ++i) {
    const long double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (is_before(middle) ? low : high) = middle;
  }
  return high;
}

/// Truth by bisection of a convex function along a ray's line: slope(t), along the line;
/// outside(t), above 0 outside of the shape, and at least the distance from it; normal(t), of any
/// length.
template <class Function>
CastTruth truth_by_bisection(const Function& function, const Ray<double>& ray, long double R) {
  using Long = long double;
  const Vec3<Long> o = ray.origin.cast<Long>(), d = ray.direction.cast<Long>();
  const Long middle = -o.dot(d) / d.squaredNorm(), around = 2 * R / d.norm();
  const Long least =
      bisected(middle - around, middle + around, [&](Long t) { return function.slope(t) < 0; });
  const auto beside = static_cast<double>(function.outside(least));
  if (beside > 0) return {false, beside, 0, Vec3<Long>::Zero()};
  const Long t =
      bisected(middle - around, least, [&](Long at) { return function.outside(at) > 0; });
  return {true, beside, t, function.normal(t).normalized()};
}

/// Distance from the silhouette, in units of R, within which either result is right.
constexpr double silhouette_band = 1e-14;

/// Statistics of many casts at one shape of bounding radius R.
struct CastOutcome {
  int hits = 0, misses = 0, others = 0, supports = 0, most_supports = 0;
  int wrong = 0;        ///< status, further from the silhouette than the band
  double worst = 0;     ///< error of t times cosine, in units of R
  double unproven = 0;  ///< distance of the lower bound behind the true hit, likewise

  void add(const CastResult<double>& result, const CastTruth& truth, const Vec3<double>& direction,
           double R) {
    using Long = long double;
    const bool hit = result.status == Status::hit;
    hits += hit;
    misses += result.status == Status::miss;
    others += !hit && result.status != Status::miss;
    supports += result.supports;
    most_supports = std::max(most_supports, result.supports);
    if (hit != truth.hit && std::abs(truth.beside) > silhouette_band * R) ++wrong;
    if (!hit || !truth.hit) return;
    const Long across = -truth.normal.dot(direction.cast<Long>());
    const auto error = [&](double offset) {
      return static_cast<double>((Long(result.t_base) + Long(offset) - truth.t) * across / R);
    };
    worst = std::max(worst, std::abs(error(result.t_offset)));
    unproven = std::max(unproven, error(result.offset_lo));
  }
};

/// Casts `count` rays of a family, and compares them with truth(ray).
template <class Truth>
CastOutcome cast_family(const Shape& shape, RayFamily family, int count, const Truth& truth,
                        const CastOptions& options = {}) {
  const PreparedShape prepared(shape);
  FamilyRays rays(shape, family, 83);
  CastOutcome outcome;
  for (int i = 0; i < count; ++i) {
    const Ray<double> ray = rays.next();
    outcome.add(cast_ray(prepared, ray, options), truth(ray), ray.direction, rays.ball().radius);
  }
  return outcome;
}

struct CastLimits {
  double worst, unproven = std::numeric_limits<double>::infinity();
  int hits = 1, others = 0;  ///< the least number of hits, and the most of others
};

inline void expect_within(const CastOutcome& outcome, const CastLimits& limits) {
  EXPECT_EQ(outcome.wrong, 0);
  EXPECT_LE(outcome.others, limits.others);
  EXPECT_GE(outcome.hits, limits.hits);
  EXPECT_LE(outcome.worst, limits.worst);
  EXPECT_LE(outcome.unproven, limits.unproven);
}

}  // namespace minkray::testing
