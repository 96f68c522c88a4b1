// SPDX-License-Identifier: MIT
// The files of renderer/inspect/page, which the build puts into the program.
#pragma once

#include <string>

namespace minkray::page_files {

std::string html();
std::string style();
std::string script();  ///< all scripts, in their order

}  // namespace minkray::page_files
