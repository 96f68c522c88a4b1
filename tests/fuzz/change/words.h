// SPDX-License-Identifier: MIT
// The words that a reader compares keys, names and values with, taken from its sources when the
// mutator is configured (tests/fuzz/CMakeLists.txt): no second list next to the reader's own.
#pragma once

#include <string>
#include <vector>

namespace minkray::fuzz {

std::vector<std::string> words_of_reader();

}  // namespace minkray::fuzz
