// SPDX-License-Identifier: MIT
// Report of `minkray render --certify`.
#pragma once

#include "renderer/audit/ray_audit.h"

namespace minkray {

/// Prints to stderr how much was proven, and each failure with a query that reproduces it.
void report(const RayAudit& audit);

}  // namespace minkray
