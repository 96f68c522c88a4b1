// SPDX-License-Identifier: MIT
// First contact of a core that moves without turning and a core at rest. Selects the method; code
// is compiled separately for the most common kinds of cores.
#pragma once

#include "core/pair_motion/swept_query.h"

namespace minkray {

/// Returns the time of impact. For the parameters see SweptPortal (swept_portal.h). `memory` may be
/// null.
SweptTime swept_time(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near,
                     PairMemory* memory, bool is_for_derivatives = false);

}  // namespace minkray
