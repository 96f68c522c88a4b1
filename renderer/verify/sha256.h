// SPDX-License-Identifier: MIT
// SHA-256 (FIPS 180-4): fingerprints of the files that a proof depends on, and of the proof itself.
#pragma once

#include <string>
#include <string_view>

namespace minkray {

/// Returns 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace minkray
