// SPDX-License-Identifier: MIT
// Casting several rays at once, each at an instance of its own of one definition: the answers are
// those of cast_ray, bit for bit.
#pragma once

#include "core/cast/packet_cast.h"

namespace minkray {

/// Where an instance stands in each lane (see PreparedShape): `to_inner` row by row.
template <class T>
struct alignas(32) PosePacket {
  std::array<PacketNumbers<T>, 3> centre;
  std::array<PacketNumbers<T>, 3> centre_low = {};  ///< what that lacks
  std::array<PacketNumbers<T>, 9> to_inner;         ///< of no meaning unless they are turned
  PacketNumbers<T> loss = {};
  bool are_turned = false;  ///< otherwise all are moved only

  void set(int lane, const PreparedShape<T>& shape) {
    const auto i = static_cast<std::size_t>(lane);
    const TwoFoldVec3<T>& of_shape = shape.two_fold_centre();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      centre[axis][i] = of_shape.high[static_cast<int>(axis)];
      centre_low[axis][i] = of_shape.low[static_cast<int>(axis)];
    }
    loss[i] = shape.place_loss();
    if (const Mat3<T>* map = shape.linear_to_inner())
      for (std::size_t k = 0; k < 9; ++k)
        to_inner[k][i] = (*map)(static_cast<int>(k / 3), static_cast<int>(k % 3));
  }
};

/// cast_ray for the lanes asked for, at a definition that has a closed form.
template <class T>
void cast_packet(const ShapeDefinition<T>& definition, const PosePacket<T>& poses,
                 const RayPacket<T>& rays, LaneBits lanes, CastPacket<T>& answers,
                 InstructionSet set = best_instruction_set());

extern template void cast_packet(const ShapeDefinition<float>&, const PosePacket<float>&,
                                 const RayPacket<float>&, LaneBits, CastPacket<float>&,
                                 InstructionSet);
extern template void cast_packet(const ShapeDefinition<double>&, const PosePacket<double>&,
                                 const RayPacket<double>&, LaneBits, CastPacket<double>&,
                                 InstructionSet);

}  // namespace minkray
