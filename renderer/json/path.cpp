// SPDX-License-Identifier: MIT
#include "renderer/json/path.h"

namespace minkray {

JsonPath JsonPath::operator/(std::string_view key) && {
  text_ += '/';
  for (const char c : key) {
    if (c == '~') {
      text_ += "~0";
    } else if (c == '/') {
      text_ += "~1";
    } else {
      text_ += c;
    }
  }
  return std::move(*this);
}

JsonPath JsonPath::operator/(std::size_t index) && {
  text_ += '/' + std::to_string(index);
  return std::move(*this);
}

const std::string& JsonPath::text() const {
  static const std::string whole_document = "/";
  return text_.empty() ? whole_document : text_;
}

}  // namespace minkray
