// SPDX-License-Identifier: MIT
// Location of a value in a JSON document: a JSON pointer (RFC 6901) such as /objects/3/shape.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace minkray {

class JsonPath {
 public:
  /// The whole document.
  JsonPath() = default;

  JsonPath operator/(std::string_view key) const& { return JsonPath(*this) / key; }
  JsonPath operator/(std::size_t index) const& { return JsonPath(*this) / index; }
  /// A path that is not needed any more takes time for the key alone.
  JsonPath operator/(std::string_view key) &&;
  JsonPath operator/(std::size_t index) &&;

  /// "/objects/3/shape"; "/" for the whole document.
  const std::string& text() const;

 private:
  std::string text_;
};

}  // namespace minkray
