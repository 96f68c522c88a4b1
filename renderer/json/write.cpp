// SPDX-License-Identifier: MIT
// Writes a JSON value as text: numbers with their shortest digits, strings with escapes.
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>

#include "renderer/json/json.h"

namespace minkray {
namespace {

void write_line_end(std::string& out, int indent, int level) {
  if (indent < 0) return;
  out += '\n';
  out.append(static_cast<std::size_t>(indent) * static_cast<std::size_t>(level), ' ');
}

/// Appends with quotes, and escapes what must be.
void write_string(std::string& out, const std::string& text) {
  try {
    out += nlohmann::json(text).dump();
  } catch (const nlohmann::json::exception& error) {
    throw std::logic_error(error.what());
  }
}

/// Appends the shortest digits that read back as the same number; null if it is not finite.
void write_real(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  std::array<char, 64> digits;
  out.append(digits.data(),
             nlohmann::detail::to_chars(digits.data(), digits.data() + digits.size(), value));
}

void write_value(std::string& out, const Json& json, int indent, int level);

/// Appends items between brackets, each in a line of its own if they are indented.
template <class Items, class Write>
void write_items(std::string& out, char open, char close, const Items& items, int indent, int level,
                 Write&& write) {
  out += open;
  bool is_first = true;
  for (const auto& item : items) {
    if (!is_first) out += ',';
    is_first = false;
    write_line_end(out, indent, level + 1);
    write(item);
  }
  if (!is_first) write_line_end(out, indent, level);
  out += close;
}

void write_value(std::string& out, const Json& json, int indent, int level) {
  switch (json.kind()) {
    case Json::Kind::null:
      out += "null";
      break;
    case Json::Kind::boolean:
      out += json.get<bool>() ? "true" : "false";
      break;
    case Json::Kind::integer:
      out += std::to_string(static_cast<std::int64_t>(json.get<std::uint64_t>()));
      break;
    case Json::Kind::natural:
      out += std::to_string(json.get<std::uint64_t>());
      break;
    case Json::Kind::real:
      write_real(out, json.get<double>());
      break;
    case Json::Kind::string:
      write_string(out, json.text());
      break;
    case Json::Kind::list:
      write_items(out, '[', ']', json, indent, level,
                  [&](const Json& item) { write_value(out, item, indent, level + 1); });
      break;
    case Json::Kind::object:
      write_items(out, '{', '}', json.members(), indent, level, [&](const Json::Member& member) {
        write_string(out, member.key);
        out += indent < 0 ? ":" : ": ";
        write_value(out, member.value, indent, level + 1);
      });
      break;
  }
}

}  // namespace

std::string Json::dump(int indent) const {
  std::string out;
  write_value(out, *this, indent, 0);
  return out;
}

std::ostream& operator<<(std::ostream& out, const Json& json) {
  return out << json.dump();
}

}  // namespace minkray
