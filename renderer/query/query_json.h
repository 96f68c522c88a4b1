// SPDX-License-Identifier: MIT
// Reads queries from JSON, strictly (docs/cast.md).
#pragma once

#include <optional>

#include "renderer/json/mistakes.h"
#include "renderer/member_json/mesh_files.h"
#include "renderer/query/query.h"

namespace minkray {

/// The query that one line describes. Nothing, and mistakes, if anything in it is wrong.
std::optional<Query> parse_query(std::string_view text, MeshFiles& meshes, Mistakes& mistakes);

}  // namespace minkray
