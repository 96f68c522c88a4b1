// SPDX-License-Identifier: MIT
// The filter (core/cast/filter.h) for packets: filter_kernel.inl compiled once with each
// instruction set's flags (core/CMakeLists.txt).
#pragma once

#include "core/cast/packet_cast.h"

namespace minkray {

/// Requires a shape with a form. Lanes in doubt are neither hit, inside nor miss.
void filter_kernel_sse2(const PreparedShape<float>& shape, const RayPacket<float>& rays,
                        LaneBits lanes, CastPacket<float>& answers);
void filter_kernel_sse2(const PreparedShape<double>& shape, const RayPacket<double>& rays,
                        LaneBits lanes, CastPacket<double>& answers);

/// Requires a machine with AVX2 and FMA.
void filter_kernel_avx2(const PreparedShape<float>& shape, const RayPacket<float>& rays,
                        LaneBits lanes, CastPacket<float>& answers);
void filter_kernel_avx2(const PreparedShape<double>& shape, const RayPacket<double>& rays,
                        LaneBits lanes, CastPacket<double>& answers);

}  // namespace minkray
