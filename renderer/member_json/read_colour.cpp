// SPDX-License-Identifier: MIT
#include "renderer/member_json/read_colour.h"

#include "core/files/text.h"
#include "renderer/image/colour.h"
#include "renderer/json/values.h"
#include "renderer/member_json/member_codec.h"

namespace minkray {

std::optional<Colour> colour_of_hex(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  Colour colour;
  for (std::size_t i = 0; i < 3; ++i) {
    unsigned code = 0;
    if (!read_number(text.substr(1 + 2 * i, 2), code, 16)) return std::nullopt;
    colour[static_cast<Eigen::Index>(i)] = from_srgb(code / 255.0);
  }
  return colour;
}

std::optional<Colour> read_colour(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                  Range range) {
  if (json.is_array()) return read_vector(json, path, mistakes, range);
  const auto colour = json.is_string() ? colour_of_hex(json.text()) : std::nullopt;
  if (!colour)
    mistakes.add(path,
                 "must be a colour: a list of 3 numbers or \"#rrggbb\" (" + found(json) + ")");
  return colour;
}

Json colour_schema(Range range) {
  return {{"oneOf", Json::array({schema_of_list(schema_of_number(range), 3),
                                 {{"type", "string"}, {"pattern", "^#[0-9A-Fa-f]{6}$"}}})}};
}

}  // namespace minkray
