// SPDX-License-Identifier: MIT
// Messages about the command line's values in the form of all others: "KEY: must be X (got Y)".
#pragma once

#include <string>

namespace minkray {

/// Rewrites a message of CLI11; others are unchanged.
std::string usage_error(const std::string& message);

}  // namespace minkray
