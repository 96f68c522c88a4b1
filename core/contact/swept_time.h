// SPDX-License-Identifier: MIT
// When two cores first touch of which one moves without turning, compiled for the kinds that are
// asked for most.
#pragma once

#include "core/contact/swept_query.h"

namespace minkray {

/// As SweptPortal has it (swept_portal.h). There may be a memory.
SweptTime swept_time(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near,
                     PairMemory* memory);

}  // namespace minkray
