// SPDX-License-Identifier: MIT
// Command line as typed, for the headers of output files.
#pragma once

#include <string>

namespace minkray {

/// Arguments of this process, separated by blanks and quoted for a shell where necessary; empty if
/// the system does not provide them.
std::string command_line();

}  // namespace minkray
