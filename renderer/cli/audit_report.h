// SPDX-License-Identifier: MIT
// What `minkray render --certify` says.
#pragma once

#include "renderer/audit/ray_audit.h"

namespace minkray {

/// Tells on stderr what was proven, and what was not with a query that shows it.
void report(const RayAudit& audit);

}  // namespace minkray
