// SPDX-License-Identifier: MIT
// MJCF, URDF and SDF, changed as XML.
#include "tests/fuzz/change/mutator.h"
#include "tests/fuzz/change/words.h"
#include "tests/fuzz/change/xml_changes.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  using namespace minkray::fuzz;
  // Static, since it learns from call to call, and libFuzzer keeps nothing for it.
  static XmlChanges changes{KnownXml(words_of_reader())};
  return mutate(changes, data, size, max_size, seed);
}
