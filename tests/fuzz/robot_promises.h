// SPDX-License-Identifier: MIT
// What every reader of robots' files promises: a model whose links are in order and a scene that
// can be described and written, or messages.
#pragma once

#include <string>
#include <string_view>

namespace minkray::fuzz {

/// Says what is wrong with the outcome; `file` says which format it is.
std::string check_robot(const std::string& text, const std::string& file);

/// The bytes are a document with that root element, or what stands within it: so inventions stay in
/// the format.
std::string check_robot_within(std::string_view root, std::string_view bytes,
                               const std::string& file);

}  // namespace minkray::fuzz
