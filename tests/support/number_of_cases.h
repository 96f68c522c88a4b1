// SPDX-License-Identifier: MIT
// Longer runs of random tests: MINKRAY_TIMES=20 in the environment makes twenty times as many
// cases, and the first of them are those of an ordinary run.
#pragma once

#include <cstdlib>

namespace minkray::testing {

inline int number_of_cases(int ordinary) {
  const char* const asked = std::getenv("MINKRAY_TIMES");
  const int factor = asked ? std::atoi(asked) : 1;
  return ordinary * (factor < 1 ? 1 : factor);
}

}  // namespace minkray::testing
