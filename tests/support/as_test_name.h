// SPDX-License-Identifier: MIT
// Names of parameterised tests.
#pragma once

#include <cctype>
#include <string>

namespace minkray::testing {

/// Replaces all characters that GoogleTest does not allow in names by _.
inline std::string as_test_name(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

}  // namespace minkray::testing
