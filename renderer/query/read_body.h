// SPDX-License-Identifier: MIT
// Reads a body of a query: a shape; or {"mesh": ...} or {"height_field": ...} as in scene files,
// with an optional "transform".
#pragma once

#include <optional>

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/member_json/mesh_files.h"
#include "renderer/query/query_body.h"

namespace minkray {

/// Nothing, and mistakes, if anything in it is wrong.
std::optional<QueryBody> read_body(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                   MeshFiles& files);

}  // namespace minkray
