// SPDX-License-Identifier: MIT
// Casts several rays at one shape at once: 8 in float, 4 in double. Results are bit-identical to
// those of cast_ray.
#pragma once

#include <array>
#include <cstdint>

#include "core/cast/cast.h"

namespace minkray {

/// Number of lanes of a packet: as many as fill 32 bytes.
template <class T>
inline constexpr int packet_lanes = static_cast<int>(32 / sizeof(T));

template <class T>
using PacketNumbers = std::array<T, static_cast<std::size_t>(packet_lanes<T>)>;

/// Rays, coordinate by coordinate. See Ray for units and meaning.
template <class T>
struct alignas(32) RayPacket {
  std::array<PacketNumbers<T>, 3> origin;
  std::array<PacketNumbers<T>, 3> direction;
  PacketNumbers<T> t_max;

  void set(int lane, const Ray<T>& ray) {
    const auto i = static_cast<std::size_t>(lane);
    for (int axis = 0; axis < 3; ++axis) {
      origin[static_cast<std::size_t>(axis)][i] = ray.origin[axis];
      direction[static_cast<std::size_t>(axis)][i] = ray.direction[axis];
    }
    t_max[i] = ray.t_max;
  }
  Ray<T> ray(int lane) const {
    const auto i = static_cast<std::size_t>(lane);
    return {{origin[0][i], origin[1][i], origin[2][i]},
            {direction[0][i], direction[1][i], direction[2][i]},
            t_max[i]};
  }
};

/// One bit per lane; the lowest bit is lane 0.
using LaneBits = std::uint32_t;
template <class T>
inline constexpr LaneBits all_lanes = (LaneBits(1) << packet_lanes<T>)-1;

/// CastResult, lane by lane. Lanes that were not requested are undefined, and so are the numbers of
/// t in lanes that miss.
template <class T>
struct alignas(32) CastPacket {
  LaneBits hit = 0, inside = 0, miss = 0;  ///< a requested lane with none of these is exhausted
  PacketNumbers<T> t_base, t_offset, offset_lo, offset_hi;
  std::array<PacketNumbers<T>, 3> normal;
  PacketNumbers<T> supports;  ///< also the number of iterations
  std::array<Path, static_cast<std::size_t>(packet_lanes<T>)> path;

  LaneBits found() const { return hit | inside; }
  T t(int lane) const {
    const auto i = static_cast<std::size_t>(lane);
    return t_base[i] + t_offset[i];
  }
  CastResult<T> result(int lane) const;
  void set(int lane, const CastResult<T>& result);
};

/// The widest instruction set that packets are compiled for and this machine has.
enum class InstructionSet : unsigned char { sse2, avx2 };
InstructionSet best_instruction_set();

/// Same as cast_ray, for the requested lanes. The machine must have the instruction set.
template <class T>
void cast_packet(const PreparedShape<T>& shape, const RayPacket<T>& rays, LaneBits lanes,
                 CastPacket<T>& answers, InstructionSet set = best_instruction_set());

/// Same as cast_exit, for the requested lanes.
template <class T>
void cast_exit_packet(const PreparedShape<T>& shape, const RayPacket<T>& rays, LaneBits lanes,
                      CastPacket<T>& answers, InstructionSet set = best_instruction_set());

extern template struct CastPacket<float>;
extern template struct CastPacket<double>;
extern template void cast_packet(const PreparedShape<float>&, const RayPacket<float>&, LaneBits,
                                 CastPacket<float>&, InstructionSet);
extern template void cast_packet(const PreparedShape<double>&, const RayPacket<double>&, LaneBits,
                                 CastPacket<double>&, InstructionSet);
extern template void cast_exit_packet(const PreparedShape<float>&, const RayPacket<float>&,
                                      LaneBits, CastPacket<float>&, InstructionSet);
extern template void cast_exit_packet(const PreparedShape<double>&, const RayPacket<double>&,
                                      LaneBits, CastPacket<double>&, InstructionSet);

}  // namespace minkray
