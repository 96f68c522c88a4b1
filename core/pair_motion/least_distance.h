// SPDX-License-Identifier: MIT
// Finds the least signed distance of two bodies that move along known paths, with proven lower and
// upper bounds.
#pragma once

#include <limits>
#include <string_view>

#include "core/pair_distance/signed_distance.h"

namespace minkray {

/// Bodies A and B whose poses are known for every path parameter s in [0, 1].
class MovingPair {
 public:
  virtual ~MovingPair() = default;

  /// Returns the signed distance at s. If it is above `at_most`, only a lower bound is required.
  virtual SignedDistance at(double s, double at_most) const = 0;
  /// Returns a lower bound, exact up to rounding, of the gap along n at s: the minimum of n.(q - p)
  /// over points p of A and q of B. `n`, `at(s).normal`, `speed` and `acceleration` must refer to
  /// the same frame.
  virtual double gap(const Vec3<double>& n, double s) const = 0;

  double size = 0;          ///< sum of the bodies' sizes; tolerances are relative to this sum
  double speed = 0;         ///< upper bound of the speed of any point of B relative to any of A
  double acceleration = 0;  ///< same, of the acceleration
  /// Lower bound of all distances, such as 0 for pairs whose distance is never negative.
  double least = -std::numeric_limits<double>::infinity();
};

struct LeastDistanceOptions {
  /// The search ends when the bounds differ by at most `gap`, or by `relative_gap` times the least
  /// distance.
  double gap = 0;  ///< in scene units
  double relative_gap = 0;
  /// The search also ends when the least distance is proven to be at least `enough` minus the gap.
  double enough = std::numeric_limits<double>::infinity();
  int max_distances = 20000;  ///< limit of calls of MovingPair::at
};

struct LeastDistance {
  /// Lower bound of the distances at all s in [0, 1].
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();  ///< upper bound of the least distance
  double s = 0;             ///< parameter of the least distance found
  SignedDistance there;     ///< distance at s
  int distances = 0;        ///< number of calls of MovingPair::at
  bool is_settled = false;  ///< true if the bounds are as near as the options require
};

/// Searches until the difference of the bounds is as small as `options` requires.
///
/// A plane with normal n separates the bodies by the gap g(n, s) at s. The gap is at most
/// the signed distance. For a fixed n the gap is the least n.(q - p) over points p of A and q of B.
/// As a function of s, each n.(q - p) has a second derivative of at most `acceleration`. So on [s0,
/// s1] the distance is at least the larger of
///
///   min(g(n, s0), g(n, s1)) - acceleration * (s1 - s0)^2 / 8   for any n, and
///   (d(s0) + d(s1) - speed * (s1 - s0)) / 2                    since `speed` bounds |d'|.
///
/// The interval with the least bound is halved until the bound is near the least distance found.
LeastDistance least_distance(const MovingPair& pair, const LeastDistanceOptions& options);

/// Returns a lower bound of the gap of two shapes along a unit vector n in the world, tight up to
/// rounding.
double gap_along(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                 const Affine<double>& pose_b, const Vec3<double>& n);
double gap_along(const ContactShape& a, const Mat3<double>& linear_a, const ContactShape& b,
                 const Mat3<double>& linear_b, const Between& between, const Vec3<double>& n);

}  // namespace minkray
