// SPDX-License-Identifier: MIT
// Comma-separated numbers as the value of an option.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/files/text.h"
#include "renderer/base/errors.h"

namespace minkray {

/// Reads finite numbers, as many as one of the counts; throws WrongUsage for anything else.
inline std::vector<double> number_list(const std::string& text, const char* option,
                                       std::initializer_list<std::size_t> counts,
                                       const char* expected) {
  const auto numbers = numbers_between(text, ',');
  if (!numbers || std::find(counts.begin(), counts.end(), numbers->size()) == counts.end())
    throw WrongUsage(std::string(option) + ": must be " + expected + " (got " + text + ")");
  return *numbers;
}

}  // namespace minkray
