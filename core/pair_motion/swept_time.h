// SPDX-License-Identifier: MIT
// First contact of two cores where one moves without turning, compiled for the most common kinds.
#pragma once

#include "core/pair_motion/swept_query.h"

namespace minkray {

/// As SweptPortal has it (swept_portal.h). There may be a memory.
SweptTime swept_time(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near,
                     PairMemory* memory);

}  // namespace minkray
