// SPDX-License-Identifier: MIT
// Verbs that live in programs of their own, which lie beside this one.
#pragma once

#include <string>

namespace minkray {

/// Becomes the program of that name beside this one, with the same command line. Throws WrongUsage
/// if it is not there, which says `otherwise`, or cannot be run.
[[noreturn]] void run_beside(const std::string& verb, const std::string& program,
                             const std::string& otherwise);

}  // namespace minkray
