// SPDX-License-Identifier: MIT
// Requirements on every message to the user, for any input.
#pragma once

#include <string>

#include "renderer/json/mistakes.h"

namespace minkray::fuzz {

/// One line each that a terminal can show, and not a novel.
inline std::string check_messages(const Mistakes& mistakes) {
  constexpr std::size_t longest = 700;
  for (const std::string& message : mistakes.messages()) {
    if (message.size() > longest)
      return "a message of " + std::to_string(message.size()) + " bytes";
    if (printable(message, longest) != message) return "not printable: " + printable(message, 300);
  }
  return "";
}

}  // namespace minkray::fuzz
