// SPDX-License-Identifier: MIT
// Where a value stands in a JSON document: a JSON pointer (RFC 6901) such as /objects/3/shape.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace minkray {

class JsonPath {
 public:
  /// The whole document.
  JsonPath() = default;

  JsonPath operator/(std::string_view key) const;
  JsonPath operator/(std::size_t index) const;

  /// "/objects/3/shape"; "/" for the whole document.
  const std::string& text() const;

 private:
  explicit JsonPath(std::string text) : text_(std::move(text)) {}

  std::string text_;
};

}  // namespace minkray
