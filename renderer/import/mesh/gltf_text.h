// SPDX-License-Identifier: MIT
// Decodes text of glTF: base64 in data: URIs, and %20 in names.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace minkray {

/// The bytes of base64 text (RFC 4648); nothing if it is none.
std::optional<std::string> from_base64(std::string_view text);

/// The text with "%20" and the like decoded (RFC 3986).
std::string percent_decoded(std::string_view text);

}  // namespace minkray
