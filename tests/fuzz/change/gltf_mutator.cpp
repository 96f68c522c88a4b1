// SPDX-License-Identifier: MIT
// glTF files, changed as the JSON that they are or hold.
#include "tests/fuzz/change/json_changes.h"
#include "tests/fuzz/change/mutator.h"
#include "tests/fuzz/change/words.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  using namespace minkray::fuzz;
  // Static, since it learns from call to call, and libFuzzer keeps nothing for it.
  static JsonChanges changes{KnownJson(words_of_reader())};
  return mutate(changes, data, size, max_size, seed);
}
