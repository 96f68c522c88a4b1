// SPDX-License-Identifier: MIT
// The body of the filter for packets. MINKRAY_FILTER_KERNEL is the function's name. All other names
// include the type of the lanes, and so the instruction set: see core/math/wide.h.
#include "core/cast/filter.h"
#include "core/cast/filter_kernel.h"
#include "core/cast/packet_lanes.h"

namespace minkray {
namespace {

/// Takes as many lanes as F has, beginning with lane `from`.
template <class F>
void filter_part(const PreparedShape<Lane<F>>& shape, const RayPacket<Lane<F>>& rays,
                 LaneBits lanes, std::size_t from, CastPacket<Lane<F>>& answers) {
  const Ray<F> ray{load<F>(rays.origin, from), load<F>(rays.direction, from),
                   F::load(rays.t_max.data() + from)};
  const Filtered<F> answer = filter<false>(shape, ray, mask_of<Work<F>>(lanes >> from));
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

/// Works in parts that fill one register with doubles, whatever T is.
template <class F>
void kernel(const PreparedShape<Lane<F>>& shape, const RayPacket<Lane<F>>& rays, LaneBits lanes,
            CastPacket<Lane<F>>& answers) {
  constexpr LaneBits every = (LaneBits(1) << LaneOf<F>::count) - 1;
  for (int at = 0; at < packet_lanes<Lane<F>>; at += LaneOf<F>::count) {
    const auto from = static_cast<std::size_t>(at);
    if (lanes >> from & every) filter_part<F>(shape, rays, lanes, from, answers);
  }
  answers.supports.fill(Lane<F>(0));
  answers.path.fill(Path::filter);
}

template <class T>
using SubPacket = Wide<T, static_cast<int>(IsaHere::register_bytes / sizeof(double)), IsaHere>;

}  // namespace

void MINKRAY_FILTER_KERNEL(const PreparedShape<float>& shape, const RayPacket<float>& rays,
                           LaneBits lanes, CastPacket<float>& answers) {
  kernel<SubPacket<float>>(shape, rays, lanes, answers);
}

void MINKRAY_FILTER_KERNEL(const PreparedShape<double>& shape, const RayPacket<double>& rays,
                           LaneBits lanes, CastPacket<double>& answers) {
  kernel<SubPacket<double>>(shape, rays, lanes, answers);
}

}  // namespace minkray
