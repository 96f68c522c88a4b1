// SPDX-License-Identifier: MIT
// Casts compared with truths in long double that need neither a solver nor support points.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/query/result.h"

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

}  // namespace minkray::testing
