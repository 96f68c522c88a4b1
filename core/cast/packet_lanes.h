// SPDX-License-Identifier: MIT
// Converts packets to lanes for the kernels. All names depend on the lanes' type, and thus on the
// instruction set: see core/math/wide.h.
#pragma once

#include "core/cast/packet_cast.h"
#include "core/math/wide.h"

namespace minkray {

template <class W>
Vec3<W> load(const std::array<PacketNumbers, 3>& v, std::size_t from) {
  return {W::load(v[0].data() + from), W::load(v[1].data() + from), W::load(v[2].data() + from)};
}

template <class W>
Mask<W> mask_of(LaneBits bits) {
  constexpr LaneBits every = (LaneBits(1) << LaneOf<W>::count) - 1;
  if ((bits & every) == every) return Mask<W>(true);
  W chosen(0.0);
  for (int i = 0; i < LaneOf<W>::count; ++i)
    chosen.set_lane(i, bits & (LaneBits(1) << i) ? 1.0 : 0.0);
  return chosen > W(0.0);
}

}  // namespace minkray
