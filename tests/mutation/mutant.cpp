// SPDX-License-Identifier: MIT
#include "tests/mutation/mutant.h"

#include <cstdio>
#include <cstdlib>

namespace minkray::mutant {

int active = 0;
bool reached[most_mutants] = {};

// Before the constants that depend on it are initialized.
[[gnu::constructor(101)]] static void read_number() {
  if (const char* number = std::getenv("MINKRAY_MUTANT")) active = std::atoi(number);
}

// Into a file that the environment names: the numbers of those that were reached.
[[gnu::destructor]] static void write_reached() {
  const char* const name = std::getenv("MINKRAY_REACHED");
  std::FILE* const file = name ? std::fopen(name, "w") : nullptr;
  if (!file) return;
  for (int k = 1; k < most_mutants; ++k)
    if (reached[k]) std::fprintf(file, "%d\n", k);
  std::fclose(file);
}

}  // namespace minkray::mutant
