// SPDX-License-Identifier: MIT
#include "renderer/cli/usage_errors.h"

#include <regex>

namespace minkray {

std::string usage_error(const std::string& message) {
  static const struct {
    std::regex found;
    const char* text;
  } messages[] = {
      {std::regex(R"re(^(.+): Value (.*) not in range (.+) to (.+)$)re"),
       "$1: must be a number from $3 to $4 (got $2)"},
      {std::regex(R"re(^(.+): At Most 1 required but received (\d+)$)re"),
       "$1: must be given once (got $2)"},
      {std::regex(R"re(^(.+): At Least (\d+) required but received (\d+)$)re",
                  std::regex::ECMAScript | std::regex::icase),
       "$1: must have at least $2 values (got $3)"},
      {std::regex(R"re(^(.+): \d+ required .+ missing$)re"), "$1: must have a value (got none)"},
      {std::regex(R"re(^Could not convert: (.+) = (.*)$)re"), "$1: must be a number (got $2)"}};
  for (const auto& [found, text] : messages)
    if (std::regex_search(message, found)) return std::regex_replace(message, found, text);
  return message;
}

}  // namespace minkray
