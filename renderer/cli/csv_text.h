// SPDX-License-Identifier: MIT
// CSV files that commands write: names in them, and the text as a file.
#pragma once

#include <span>
#include <string>

#include "renderer/io/output_file.h"

namespace minkray {

/// Quotes a name that contains a comma or a quote.
inline std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

inline void write_text(const std::string& file, const std::string& text) {
  write_file(file, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

}  // namespace minkray
