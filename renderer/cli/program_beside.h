// SPDX-License-Identifier: MIT
// Verbs that live in other programs, which lie beside this one.
#pragma once

#include <string>

namespace minkray {

/// Becomes the program, which has the verb, with the same command line. Throws WrongUsage if it is
/// not there or cannot be run.
[[noreturn]] void run_beside(const std::string& verb, const std::string& program);

}  // namespace minkray
