// SPDX-License-Identifier: MIT
// Runs commands that are in other programs, in the same folder as this one.
#pragma once

#include <string>
#include <vector>

namespace minkray {

/// Replaces this process by the program that has the command, with the words of a command line.
/// Throws WrongUsage if the program is missing or cannot be run.
[[noreturn]] void run_beside(const std::string& verb, const std::string& program,
                             std::vector<std::string> words);

/// Words of this process's command line.
std::vector<std::string> own_words();

}  // namespace minkray
