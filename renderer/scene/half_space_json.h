// SPDX-License-Identifier: MIT
// Half-spaces in scene files: {"type": "plane", "normal": [0, 0, 1], "offset": 0} in the place of
// an object's shape.
#pragma once

#include <optional>

#include "core/world/half_space.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

bool is_half_space(const Json& shape);

/// Nothing, and mistakes, if anything in it is wrong. The normal may have any length but zero;
/// "offset" is along it.
std::optional<HalfSpaceBody<double>> read_half_space(const Json& json, const JsonPath& path,
                                                     Mistakes& mistakes);

Json write_half_space(const HalfSpaceBody<double>& half_space);

}  // namespace minkray
