// SPDX-License-Identifier: MIT
// Comma-separated numbers as the value of an option.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "renderer/base/errors.h"

namespace minkray {

/// Reads finite numbers, as many as one of the counts; throws WrongUsage for anything else.
inline std::vector<double> number_list(const std::string& text, const char* option,
                                       std::initializer_list<std::size_t> counts,
                                       const char* expected) {
  std::vector<double> numbers;
  const char *at = text.data(), *const end = at + text.size();
  while (at != end) {
    double number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number) || (next != end && *next != ',')) break;
    numbers.push_back(number);
    at = next == end ? next : next + 1;
  }
  const bool fits = std::find(counts.begin(), counts.end(), numbers.size()) != counts.end();
  if (at != end || !fits)
    throw WrongUsage(std::string(option) + ": must be " + expected + " (got " + text + ")");
  return numbers;
}

}  // namespace minkray
