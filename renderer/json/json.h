// SPDX-License-Identifier: MIT
// The JSON value. The one place where nlohmann-json is included.
#pragma once

#include <nlohmann/json.hpp>

namespace minkray {

/// Keeps the keys of objects in the order they were written or added.
using Json = nlohmann::ordered_json;

}  // namespace minkray
