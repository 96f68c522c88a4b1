// SPDX-License-Identifier: MIT
// Scene files and queries, changed as JSON. The schema describes their possible contents.
#include "renderer/scene_json/schema.h"
#include "tests/fuzz/change/json_changes.h"
#include "tests/fuzz/change/mutator.h"
#include "tests/fuzz/change/words.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  using namespace minkray::fuzz;
  // Static, since it learns from call to call, and libFuzzer keeps nothing for it.
  static JsonChanges changes([] {
    KnownJson known(words_of_reader());
    known.learn_schema(JsonValue::parse(minkray::scene_schema().dump()));
    return known;
  }());
  return mutate(changes, data, size, max_size, seed);
}
