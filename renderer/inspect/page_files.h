// SPDX-License-Identifier: MIT
// The files of renderer/inspect/page, which the build puts into the program.
#pragma once

#include <string_view>

namespace minkray::page_files {

extern const std::string_view html;
extern const std::string_view style;
extern const std::string_view script;  ///< all scripts, in their order

}  // namespace minkray::page_files
