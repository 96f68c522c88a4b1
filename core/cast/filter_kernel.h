// SPDX-License-Identifier: MIT
// The filter (core/cast/filter.h) for packets: filter_kernel.inl compiled once with each
// instruction set's flags (core/CMakeLists.txt).
#pragma once

#include "core/cast/packet_cast.h"

namespace minkray {

/// Casts the requested lanes. Requires a shape with a closed form. Lanes in doubt are neither hit,
/// inside nor miss.
void filter_kernel_sse2(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                        CastPacket& answers);

/// Same; requires a machine with AVX2 and FMA.
void filter_kernel_avx2(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                        CastPacket& answers);

}  // namespace minkray
