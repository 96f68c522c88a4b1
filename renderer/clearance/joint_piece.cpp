// SPDX-License-Identifier: MIT
#include "renderer/clearance/joint_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace minkray {
namespace {

/// The largest Bernstein coefficient of a polynomial on [0, 1], without its sign, and what rounding
/// could take from it.
double largest_coefficient(std::span<const double> powers) {
  const std::size_t degree = powers.size() - 1;
  double largest = 0, sum = 0;
  for (const double power : powers) sum += std::abs(power);
  for (std::size_t i = 0; i <= degree; ++i) {
    // The weight of power k is C(i, k) / C(degree, k).
    double coefficient = 0, weight = 1;
    for (std::size_t k = 0; k <= i; ++k) {
      coefficient += weight * powers[k];
      weight *= static_cast<double>(i - k) / static_cast<double>(degree - k);
    }
    largest = std::max(largest, std::abs(coefficient));
  }
  return largest + 32 * std::numeric_limits<double>::epsilon() * sum;
}

}  // namespace

JointPiece::JointPiece(const JointEnds& ends, std::span<const double> powers)
    : first_(ends.first), last_(ends.last), degree_(powers.size()) {
  std::ranges::copy(powers, powers_.begin());
}

JointPiece JointPiece::cubic(const JointEnds& ends) {
  const double way = ends.last - ends.first;
  const auto [u, v] = ends.rates;
  return {ends, std::array{u, 3 * way - 2 * u - v, u + v - 2 * way}};
}

JointPiece JointPiece::quintic(const JointEnds& ends) {
  const double way = ends.last - ends.first;
  const auto [u, v] = ends.rates;
  const auto [a, b] = ends.accelerations;
  return {ends, std::array{u, a / 2, 10 * way - 6 * u - 4 * v - (3 * a - b) / 2,
                           -15 * way + 8 * u + 7 * v + (3 * a - 2 * b) / 2,
                           6 * way - 3 * (u + v) - (a - b) / 2}};
}

TwoFold<double> JointPiece::at(double s) const {
  double gone = 0;
  for (std::size_t k = degree_; k-- > 0;) gone = s * (powers_[k] + gone);
  return two_sum(first_, gone);
}

double JointPiece::rounded_at(double s) const {
  if (s == 0) return first_;
  if (s == 1) return last_;
  return at(s).high;
}

double JointPiece::derivative_at(double s) const {
  double sum = 0;
  for (std::size_t k = degree_; k-- > 0;) sum = s * sum + static_cast<double>(k + 1) * powers_[k];
  return sum;
}

double JointPiece::way() const {
  double sum = 0;
  for (const double power : powers()) sum += std::abs(power);
  return sum;
}

double JointPiece::largest() const {
  if (is_straight()) return std::max(std::abs(first_), std::abs(last_));
  std::array<double, 6> all = {first_};
  std::ranges::copy(powers(), all.begin() + 1);
  return largest_coefficient({all.data(), degree_ + 1});
}

double JointPiece::fastest() const {
  if (is_straight()) return std::abs(powers_[0]);
  std::array<double, 5> all;
  for (std::size_t k = 0; k < degree_; ++k) all[k] = static_cast<double>(k + 1) * powers_[k];
  return largest_coefficient({all.data(), degree_});
}

double JointPiece::most_bent() const {
  if (is_straight()) return 0;
  std::array<double, 4> all;
  for (std::size_t k = 1; k < degree_; ++k)
    all[k - 1] = static_cast<double>((k + 1) * k) * powers_[k];
  return largest_coefficient({all.data(), degree_ - 1});
}

}  // namespace minkray
