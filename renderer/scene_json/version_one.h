// SPDX-License-Identifier: MIT
// What scene files of version 1 may not hold, since programs that know that version alone could not
// read it.
#pragma once

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

/// Adds a mistake at each key or value of version 2 that tells which version to write. Other
/// mistakes are not looked for.
void refuse_version_two(const Json& scene, Mistakes& mistakes);

}  // namespace minkray
