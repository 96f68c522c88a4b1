// SPDX-License-Identifier: MIT
// Suggests the name that is closest to a mistyped word.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace minkray {

/// The name of the fewest changed letters (optimal string alignment, Damerau 1964), if these are at
/// most a third of its letters.
std::optional<std::string> closest_word(std::string_view written,
                                        const std::vector<std::string>& names);

}  // namespace minkray
