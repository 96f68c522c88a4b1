// SPDX-License-Identifier: MIT
// Guarantees of every reader of robots' files: a model whose links are in order and a scene that
// can be described and written, or messages.
#pragma once

#include <string>
#include <string_view>

namespace minkray::fuzz {

/// Returns a description of an error in the outcome; the extension of `file` selects the format.
std::string check_robot(const std::string& text, const std::string& file);

/// The bytes are a document with that root element, or its contents: so inventions stay in the
/// format.
std::string check_robot_within(std::string_view root, std::string_view bytes,
                               const std::string& file);

}  // namespace minkray::fuzz
