// SPDX-License-Identifier: MIT
// Our solvers, one ray at a time, and in packets.
#pragma once

#include "bench/peers/peer.h"

namespace minkray::bench {

/// `sweep`: the paper's solver at every tolerance, not just at 1e-4 and its default.
Peers scalar_solvers(const Shape& shape, bool sweep);

/// Casts of many rays at once: this is the place for them.
Peers packet_solvers(const Shape& shape);

}  // namespace minkray::bench
