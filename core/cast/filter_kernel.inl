// SPDX-License-Identifier: MIT
// The body of the filter for packets. MINKRAY_FILTER_KERNEL is the function's name. Everything else
// here has the type of the lanes, and so the instruction set, in its name: see core/math/wide.h.
#include "core/cast/filter.h"
#include "core/cast/filter_kernel.h"
#include "core/cast/packet_lanes.h"
#include "core/cast/posed_in_lanes.h"

namespace minkray {
namespace {

/// It takes as many lanes as F has, beginning with lane `from`.
template <class F, class Placed>
void filter_part(const Placed& shape, const RayPacket<Lane<F>>& rays, LaneBits lanes,
                 std::size_t from, CastPacket<Lane<F>>& answers) {
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

/// It goes in parts of which the instruction set's registers hold the doubles, whatever T is.
/// placed(from) is the shape as the lanes from there see it.
template <class F, class PlacedAt>
void kernel(const PlacedAt& placed, const RayPacket<Lane<F>>& rays, LaneBits lanes,
            CastPacket<Lane<F>>& answers) {
  constexpr LaneBits every = (LaneBits(1) << LaneOf<F>::count) - 1;
  for (int at = 0; at < packet_lanes<Lane<F>>; at += LaneOf<F>::count) {
    const auto from = static_cast<std::size_t>(at);
    if (lanes >> from & every) filter_part<F>(placed(from), rays, lanes, from, answers);
  }
  answers.supports.fill(Lane<F>(0));
  answers.path.fill(Path::filter);
}

template <class T>
using SubPacket = Wide<T, static_cast<int>(IsaHere::register_bytes / sizeof(double)), IsaHere>;

template <class F>
void at_one(const PreparedShape<Lane<F>>& shape, const RayPacket<Lane<F>>& rays, LaneBits lanes,
            CastPacket<Lane<F>>& answers) {
  kernel<F>(
      [&](std::size_t) -> const auto& { return shape; }, rays, lanes, answers);
}

template <class F>
void at_poses(const ShapeDefinition<Lane<F>>& definition, const PosePacket<Lane<F>>& poses,
              const RayPacket<Lane<F>>& rays, LaneBits lanes, CastPacket<Lane<F>>& answers) {
  kernel<F>([&](std::size_t from) { return PosedInLanes<F>(definition, poses, from); }, rays, lanes,
            answers);
}

}  // namespace

void MINKRAY_FILTER_KERNEL(const PreparedShape<float>& shape, const RayPacket<float>& rays,
                           LaneBits lanes, CastPacket<float>& answers) {
  at_one<SubPacket<float>>(shape, rays, lanes, answers);
}

void MINKRAY_FILTER_KERNEL(const PreparedShape<double>& shape, const RayPacket<double>& rays,
                           LaneBits lanes, CastPacket<double>& answers) {
  at_one<SubPacket<double>>(shape, rays, lanes, answers);
}

void MINKRAY_FILTER_KERNEL(const ShapeDefinition<float>& definition, const PosePacket<float>& poses,
                           const RayPacket<float>& rays, LaneBits lanes,
                           CastPacket<float>& answers) {
  at_poses<SubPacket<float>>(definition, poses, rays, lanes, answers);
}

void MINKRAY_FILTER_KERNEL(const ShapeDefinition<double>& definition,
                           const PosePacket<double>& poses, const RayPacket<double>& rays,
                           LaneBits lanes, CastPacket<double>& answers) {
  at_poses<SubPacket<double>>(definition, poses, rays, lanes, answers);
}

}  // namespace minkray
