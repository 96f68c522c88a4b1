// SPDX-License-Identifier: MIT
#include "core/cast/packet_cast.h"

#include <cmath>

#include "core/cast/filter_kernel.h"
#include "core/cast/later_stages.h"
#include "core/cast/packet_kernel.h"

namespace minkray {

CastResult<double> CastPacket::result(int lane) const {
  const auto i = static_cast<std::size_t>(lane);
  const LaneBits bit = LaneBits(1) << lane;
  CastResult<double> result;
  result.status = hit & bit      ? Status::hit
                  : inside & bit ? Status::inside
                  : miss & bit   ? Status::miss
                                 : Status::exhausted;
  result.path = path[i];
  result.offset_hi = 0.0;
  if (result.found()) {
    result.t_base = t_base[i];
    result.t_offset = t_offset[i];
    result.offset_lo = offset_lo[i];
    result.offset_hi = offset_hi[i];
  }
  result.normal = {normal[0][i], normal[1][i], normal[2][i]};
  result.iterations = result.supports = static_cast<int>(supports[i]);
  return result;
}

void CastPacket::set(int lane, const CastResult<double>& result) {
  const auto i = static_cast<std::size_t>(lane);
  const LaneBits bit = LaneBits(1) << lane;
  hit = (hit & ~bit) | (result.status == Status::hit ? bit : 0);
  inside = (inside & ~bit) | (result.status == Status::inside ? bit : 0);
  miss = (miss & ~bit) | (result.status == Status::miss ? bit : 0);
  t_base[i] = result.t_base;
  t_offset[i] = result.t_offset;
  offset_lo[i] = result.offset_lo;
  offset_hi[i] = result.offset_hi;
  for (int axis = 0; axis < 3; ++axis)
    normal[static_cast<std::size_t>(axis)][i] = result.normal[axis];
  supports[i] = static_cast<double>(result.supports);
  path[i] = result.path;
}

namespace {

/// Casts with the shape's model, if packets support the model; otherwise leaves all lanes
/// undecided.
void cast_with_models(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                      bool leaves, CastPacket& answers, InstructionSet set) {
  if (!shape.definition().has_packets()) return;
  answers.path.fill(Path::model);
  if (set == InstructionSet::avx2)
    packet_kernel_avx2(shape, rays, lanes, leaves, answers);
  else
    packet_kernel_sse2(shape, rays, lanes, leaves, answers);
}

}  // namespace

void cast_packet(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                 CastPacket& answers, InstructionSet set) {
  answers.hit = answers.inside = answers.miss = 0;
  if (shape.definition().form().kind != FormKind::none) {
    if (set == InstructionSet::avx2)
      filter_kernel_avx2(shape, rays, lanes, answers);
    else
      filter_kernel_sse2(shape, rays, lanes, answers);
  } else {
    cast_with_models(shape, rays, lanes, false, answers, set);
  }
  for (int lane = 0; lane < packet_lanes; ++lane) {
    const auto i = static_cast<std::size_t>(lane);
    if (!(answers.hit >> lane & 1u) || !std::isinf(answers.offset_hi[i])) continue;
    CastResult<double> result = answers.result(lane);
    bound_hit(shape, rays.ray(lane), result);
    answers.set(lane, result);
  }
  // Lanes that the filter leaves in doubt, or whose model does not converge, are cast one by one.
  const LaneBits open = lanes & ~(answers.hit | answers.inside | answers.miss);
  if (!open) return;
  for (int lane = 0; lane < packet_lanes; ++lane)
    if (open & (LaneBits(1) << lane))
      answers.set(lane, cast_by_later_stages(shape, rays.ray(lane), {}, {}));
}

void cast_exit_packet(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                      CastPacket& answers, InstructionSet set) {
  answers.hit = answers.inside = answers.miss = 0;
  if (shape.definition().form().kind == FormKind::none)
    cast_with_models(shape, rays, lanes, true, answers, set);
  answers.hit &= lanes;
  answers.inside = answers.miss = 0;
  for (int lane = 0; lane < packet_lanes; ++lane) {
    const LaneBits bit = LaneBits(1) << lane;
    if (answers.hit & bit)
      answers.offset_lo[static_cast<std::size_t>(lane)] = -std::numeric_limits<double>::infinity();
    else if (lanes & bit)
      answers.set(lane, cast_exit(shape, rays.ray(lane)));
  }
}

}  // namespace minkray
