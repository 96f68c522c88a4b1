// SPDX-License-Identifier: MIT
#include "tests/mutation/mutant.h"

#include <cstdlib>

namespace minkray::mutant {

int active = 0;

// Before the constants that depend on it are initialized.
[[gnu::constructor(101)]] static void read_number() {
  if (const char* number = std::getenv("MINKRAY_MUTANT")) active = std::atoi(number);
}

}  // namespace minkray::mutant
