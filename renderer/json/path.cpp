// SPDX-License-Identifier: MIT
#include "renderer/json/path.h"

namespace minkray {

JsonPath JsonPath::operator/(std::string_view key) const {
  std::string text = text_;
  text.reserve(text_.size() + key.size() + 1);
  text += '/';
  for (const char c : key) {
    if (c == '~') {
      text += "~0";
    } else if (c == '/') {
      text += "~1";
    } else {
      text += c;
    }
  }
  return JsonPath(std::move(text));
}

JsonPath JsonPath::operator/(std::size_t index) const {
  return JsonPath(text_ + '/' + std::to_string(index));
}

const std::string& JsonPath::text() const {
  static const std::string whole_document = "/";
  return text_.empty() ? whole_document : text_;
}

}  // namespace minkray
