// SPDX-License-Identifier: MIT
// The packet casts for each instruction set: packet_kernel.inl compiled once with each set's flags
// (core/CMakeLists.txt).
#pragma once

#include "core/cast/packet_cast.h"

namespace minkray {

/// Casts the requested lanes at a shape that has a model (core/model). Lanes that do not converge
/// are neither hit, inside nor miss. If `leaves`, hits are where rays leave the shape, and lanes
/// without a hit are undecided.
void packet_kernel_sse2(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                        bool leaves, CastPacket& answers);

/// Same; requires a machine with AVX2 and FMA.
void packet_kernel_avx2(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                        bool leaves, CastPacket& answers);

}  // namespace minkray
