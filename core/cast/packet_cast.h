// SPDX-License-Identifier: MIT
// Casts one packet of rays at one shape at once. Results are bit-identical to those of cast_ray.
#pragma once

#include <array>
#include <cstdint>

#include "core/cast/cast.h"
#include "core/math/instruction_set.h"

namespace minkray {

/// Number of lanes of a packet: as many as fill 32 bytes.
inline constexpr int packet_lanes = static_cast<int>(32 / sizeof(double));

using PacketNumbers = std::array<double, static_cast<std::size_t>(packet_lanes)>;

/// Rays, coordinate by coordinate; units and meaning are those of Ray.
struct alignas(32) RayPacket {
  std::array<PacketNumbers, 3> origin;
  std::array<PacketNumbers, 3> direction;
  PacketNumbers t_max;

  void set(int lane, const Ray<double>& ray) {
    const auto i = static_cast<std::size_t>(lane);
    for (int axis = 0; axis < 3; ++axis) {
      origin[static_cast<std::size_t>(axis)][i] = ray.origin[axis];
      direction[static_cast<std::size_t>(axis)][i] = ray.direction[axis];
    }
    t_max[i] = ray.t_max;
  }
  Ray<double> ray(int lane) const {
    const auto i = static_cast<std::size_t>(lane);
    return {{origin[0][i], origin[1][i], origin[2][i]},
            {direction[0][i], direction[1][i], direction[2][i]},
            t_max[i]};
  }
};

/// One bit per lane; the lowest bit is lane 0.
using LaneBits = std::uint32_t;
inline constexpr LaneBits all_lanes = (LaneBits(1) << packet_lanes) - 1;

/// CastResult, lane by lane. Lanes that were not requested are undefined. In lanes that miss, the
/// members for t and its bounds are undefined.
struct alignas(32) CastPacket {
  LaneBits hit = 0, inside = 0, miss = 0;  ///< a requested lane with none of these is exhausted
  PacketNumbers t_base, t_offset, offset_lo, offset_hi;
  std::array<PacketNumbers, 3> normal;
  PacketNumbers supports;  ///< number of support calls, which is also that of iterations
  std::array<Path, static_cast<std::size_t>(packet_lanes)> path;

  LaneBits found() const { return hit | inside; }
  double t(int lane) const {
    const auto i = static_cast<std::size_t>(lane);
    return t_base[i] + t_offset[i];
  }
  CastResult<double> result(int lane) const;
  void set(int lane, const CastResult<double>& result);
};

/// Same as cast_ray, for the requested lanes. The machine must have the instruction set.
void cast_packet(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                 CastPacket& answers, InstructionSet set = best_instruction_set());

/// Same as cast_exit, for the requested lanes.
void cast_exit_packet(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                      CastPacket& answers, InstructionSet set = best_instruction_set());

}  // namespace minkray
