// SPDX-License-Identifier: MIT
// Suggestions for unknown words: equivalents of other programs' words, and corrections of mistyped
// ones.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace minkray {

/// "did you mean `render`?", or the equivalent of another program's word; empty if nothing is
/// close.
std::string command_meant(std::string_view typed, const std::vector<std::string>& commands);
std::string option_meant(std::string_view typed, const std::vector<std::string>& options);
std::string value_meant(std::string_view typed, const std::vector<std::string>& values);

}  // namespace minkray
