// SPDX-License-Identifier: MIT
// Verbs that live in other programs, which lie beside this one.
#pragma once

#include <string>
#include <vector>

namespace minkray {

/// Becomes the program, which has the verb, with the words of a command line. Throws WrongUsage if
/// it is not there or cannot be run.
[[noreturn]] void run_beside(const std::string& verb, const std::string& program,
                             std::vector<std::string> words);

/// The words of this process's command line.
std::vector<std::string> own_words();

}  // namespace minkray
