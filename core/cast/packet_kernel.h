// SPDX-License-Identifier: MIT
// The packet casts for each instruction set: packet_kernel.inl compiled once with each set's flags
// (core/CMakeLists.txt).
#pragma once

#include "core/cast/packet_cast.h"

namespace minkray {

/// Requires a shape with a model. Lanes that do not converge are neither hit, inside nor miss.
void packet_kernel_sse2(const PreparedShape<float>& shape, const RayPacket<float>& rays,
                        LaneBits lanes, CastPacket<float>& answers);
void packet_kernel_sse2(const PreparedShape<double>& shape, const RayPacket<double>& rays,
                        LaneBits lanes, CastPacket<double>& answers);

/// Requires a machine with AVX2 and FMA.
void packet_kernel_avx2(const PreparedShape<float>& shape, const RayPacket<float>& rays,
                        LaneBits lanes, CastPacket<float>& answers);
void packet_kernel_avx2(const PreparedShape<double>& shape, const RayPacket<double>& rays,
                        LaneBits lanes, CastPacket<double>& answers);

}  // namespace minkray
