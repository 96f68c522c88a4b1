// SPDX-License-Identifier: MIT
// Means of simple functions over intervals in closed form, by their integrals. Intervals too narrow
// for rounding are replaced by their middle.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace minkray {

/// Below this part of a repeat a difference of integrals would be rounding.
inline constexpr double least_filter_width = 1e-6;

/// value(x), or the mean of it around x by its integral.
template <class Value, class Integral>
double mean_around(double x, double width, const Value& value, const Integral& integral) {
  if (!(width > least_filter_width)) return value(x);
  return (integral(x + 0.5 * width) - integral(x - 0.5 * width)) / width;
}

/// 1 in fields that begin at even numbers, -1 in the others.
inline double mean_of_fields(double x, double width) {
  const auto value = [](double at) { return std::remainder(std::floor(at), 2) == 0 ? 1.0 : -1.0; };
  const auto integral = [](double at) {
    const double in_pair = at - 2 * std::floor(at / 2);
    return std::min(in_pair, 2 - in_pair);
  };
  return std::clamp(mean_around(x, width, value, integral), -1.0, 1.0);
}

/// 1 on lines of that thickness around whole numbers, 0 between them.
inline double mean_of_lines(double x, double width, double thickness) {
  const auto value = [&](double at) {
    return std::abs(std::remainder(at, 1)) < thickness / 2 ? 1.0 : 0.0;
  };
  const auto integral = [&](double at) {
    const double whole = std::round(at);
    return whole * thickness + std::clamp(at - whole, -thickness / 2, thickness / 2);
  };
  return std::clamp(mean_around(x, width, value, integral), 0.0, 1.0);
}

/// x between 0 and 1.
inline double mean_of_ramp(double x, double width) {
  const auto value = [](double at) { return std::clamp(at, 0.0, 1.0); };
  const auto integral = [](double at) {
    const double in_ramp = std::clamp(at, 0.0, 1.0);
    return 0.5 * in_ramp * in_ramp + std::max(at - 1, 0.0);
  };
  return mean_around(x, width, value, integral);
}

/// The cube of what x is beyond a whole number.
inline double mean_of_cubes(double x, double width) {
  const auto value = [](double at) {
    const double part = at - std::floor(at);
    return part * part * part;
  };
  const auto integral = [](double at) {
    const double whole = std::floor(at), part = at - whole;
    return (whole + part * part * part * part) / 4;
  };
  return std::clamp(mean_around(x, width, value, integral), 0.0, 1.0);
}

/// ((1 + sin(2 pi x)) / 2)^4, which is a sum of four waves.
inline double mean_of_veins(double x, double width) {
  using std::numbers::pi;
  if (!(width > least_filter_width)) return std::pow(0.5 + 0.5 * std::sin(2 * pi * x), 4);
  constexpr double strengths[] = {56.0 / 128, 28.0 / 128, 8.0 / 128, 1.0 / 128};
  double sum = 35.0 / 128;
  for (int i = 0; i < 4; ++i) {
    const double half = (i + 1) * pi * width;
    sum += strengths[i] * std::cos((i + 1) * (2 * pi * x - pi / 2)) * std::sin(half) / half;
  }
  return std::clamp(sum, 0.0, 1.0);
}

}  // namespace minkray
