// SPDX-License-Identifier: MIT
// The body of the filter for packets. MINKRAY_FILTER_KERNEL is the function's name. All other names
// include the type of the lanes, and so the instruction set: see core/math/wide.h.
#include "core/cast/filter.h"
#include "core/cast/filter_kernel.h"
#include "core/cast/packet_lanes.h"

namespace minkray {
namespace {

using Lanes = Wide<double, static_cast<int>(IsaHere::register_bytes / sizeof(double)), IsaHere>;

/// Takes as many lanes as a register has, beginning with lane `from`.
void filter_part(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                 std::size_t from, CastPacket& answers) {
  using W = Lanes;
  const Ray<W> ray{load<W>(rays.origin, from), load<W>(rays.direction, from),
                   W::load(rays.t_max.data() + from)};
  const Filtered<W> answer = filter<false>(shape, ray, mask_of<W>(lanes >> from));
  answers.hit |= lane_bits(answer.hit) << from;
  answers.inside |= lane_bits(answer.inside) << from;
  answers.miss |= lane_bits(answer.miss) << from;
  answer.t_base.store(answers.t_base.data() + from);
  answer.t_offset.store(answers.t_offset.data() + from);
  answer.offset_lo.store(answers.offset_lo.data() + from);
  answer.offset_hi.store(answers.offset_hi.data() + from);
  for (int axis = 0; axis < 3; ++axis)
    answer.normal[axis].store(answers.normal[static_cast<std::size_t>(axis)].data() + from);
}

}  // namespace

void MINKRAY_FILTER_KERNEL(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                           CastPacket& answers) {
  constexpr LaneBits every = (LaneBits(1) << LaneOf<Lanes>::count) - 1;
  for (int at = 0; at < packet_lanes; at += LaneOf<Lanes>::count) {
    const auto from = static_cast<std::size_t>(at);
    if (lanes >> from & every) filter_part(shape, rays, lanes, from, answers);
  }
  answers.supports.fill(0);
  answers.path.fill(Path::filter);
}

}  // namespace minkray
