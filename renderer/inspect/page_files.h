// SPDX-License-Identifier: MIT
// Files of renderer/inspect/page, embedded in the program by the build.
#pragma once

#include <string>

namespace minkray::page_files {

std::string html();
std::string style();
std::string script();  ///< all scripts, in their order

}  // namespace minkray::page_files
