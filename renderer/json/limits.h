// SPDX-License-Identifier: MIT
// Limits of the numbers that a range allows.
#pragma once

#include <limits>
#include <string_view>

#include "core/support/field.h"

namespace minkray {

struct Limits {
  double least, most;     ///< infinite: no limit
  bool are_excluded;      ///< false if the limits themselves are allowed
  std::string_view text;  ///< "> 0", ">= 0" and so on; empty if any number will do

  bool allow(double number) const {
    return are_excluded ? number > least && number < most : number >= least && number <= most;
  }
};

inline const Limits& limits_of(Range range) {
  constexpr double none = std::numeric_limits<double>::infinity();
  static constexpr Limits any{-none, none, false, ""}, positive{0, none, true, "> 0"},
      not_negative{0, none, false, ">= 0"}, at_least_one{1, none, false, ">= 1"},
      zero_to_one{0, 1, false, ">= 0 and <= 1"}, zero_to_180{0, 180, true, "> 0 and < 180"},
      brightness{0, most_brightness, false, ">= 0 and <= 1e15"};
  switch (range) {
    case Range::any:
      break;
    case Range::positive:
      return positive;
    case Range::not_negative:
      return not_negative;
    case Range::at_least_one:
      return at_least_one;
    case Range::zero_to_one:
      return zero_to_one;
    case Range::zero_to_180:
      return zero_to_180;
    case Range::brightness:
      return brightness;
  }
  return any;
}

}  // namespace minkray
