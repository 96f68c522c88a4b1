// SPDX-License-Identifier: MIT
// The command line as it was typed, for the headers of files it made.
#pragma once

#include <string>

namespace minkray {

/// The arguments of this process between blanks, quoted for a shell where they need it; empty where
/// the system does not tell.
std::string command_line();

}  // namespace minkray
