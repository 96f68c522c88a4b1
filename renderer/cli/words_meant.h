// SPDX-License-Identifier: MIT
// What somebody likely meant who typed a word that is not known: words of other programs, and
// mistyped ones.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace minkray {

/// "did you mean `render`?", or what another program's word is here; empty if nothing is close.
std::string command_meant(std::string_view typed, const std::vector<std::string>& commands);
std::string option_meant(std::string_view typed, const std::vector<std::string>& options);
std::string value_meant(std::string_view typed, const std::vector<std::string>& values);

}  // namespace minkray
