// SPDX-License-Identifier: MIT
// One number of a joint between two rows: a polynomial of degree 1, 3 or 5 in s from 0 to 1, as
// ros2_control executes rows with velocities and accelerations. Bounds are the least and greatest
// Bernstein coefficient (R. Farouki, V. Rajan, 1987).
#pragma once

#include <array>
#include <span>

#include "core/math/two_fold.h"

namespace minkray {

/// Values, and derivatives by s, at both ends.
struct JointEnds {
  double first = 0, last = 0;
  std::array<double, 2> rates = {0, 0}, accelerations = {0, 0};
};

class JointPiece {
 public:
  /// At a constant rate.
  JointPiece(double first, double last) : first_(first), last_(last), powers_{last - first} {}
  static JointPiece cubic(const JointEnds& ends);
  static JointPiece quintic(const JointEnds& ends);

  /// The value at s, in twice the digits, but for some epsilons of way().
  TwoFold<double> at(double s) const;
  /// The two ends exactly as they were given, all else rounded.
  double rounded_at(double s) const;
  double derivative_at(double s) const;

  double first() const { return first_; }
  bool is_straight() const { return degree_ == 1; }
  /// Coefficients of s, s^2 ... s^5.
  std::span<const double> powers() const { return {powers_.data(), degree_}; }

  /// The sum of the coefficients: what rounding is relative to.
  double way() const;
  /// No less than the value anywhere on [0, 1], without its sign.
  double largest() const;
  /// No less than the first and the second derivative by s anywhere, without their signs.
  double fastest() const;
  double most_bent() const;

 private:
  JointPiece(const JointEnds& ends, std::span<const double> powers);

  double first_, last_;
  std::array<double, 5> powers_ = {};
  std::size_t degree_ = 1;
};

}  // namespace minkray
