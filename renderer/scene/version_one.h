// SPDX-License-Identifier: MIT
// Checks that a scene file of version 1 uses no later keys, which programs for version 1 cannot
// read.
#pragma once

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

/// Adds a mistake at each key or value of version 2, with the version to write. Other mistakes are
/// ignored.
void refuse_version_two(const Json& scene, Mistakes& mistakes);

}  // namespace minkray
