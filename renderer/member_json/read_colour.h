// SPDX-License-Identifier: MIT
// Colours in scene files: three numbers of linear RGB, or "#rrggbb" in sRGB as browsers and drawing
// programs write it, which becomes linear.
#pragma once

#include <optional>

#include "core/support/field.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/scene/textures.h"

namespace minkray {

/// Parameters of three numbers in these ranges are colours; places and sizes have others.
constexpr bool is_of_colours(Range range) {
  return range == Range::zero_to_one || range == Range::brightness;
}

/// The linear colour of "#rrggbb"; nothing if the text is none.
std::optional<Colour> colour_of_hex(std::string_view text);

/// Nothing, and a mistake, if it is no colour in the range.
std::optional<Colour> read_colour(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                  Range range);

/// A colour as a schema, without a description.
Json colour_schema(Range range);

}  // namespace minkray
