// SPDX-License-Identifier: MIT
// A definition under a pose in each lane, as the filter asks for it.
#pragma once

#include "core/cast/packet_lanes.h"
#include "core/cast/posed_packet.h"

namespace minkray {

/// As much of PreparedShape as the filter needs.
template <class F>
class PosedInLanes {
 public:
  PosedInLanes(const ShapeDefinition<Lane<F>>& definition, const PosePacket<Lane<F>>& poses,
               std::size_t from)
      : definition_(definition),
        centre_(load<F>(poses.centre, from)),
        are_turned_(poses.are_turned) {
    if (!are_turned_) return;
    for (std::size_t k = 0; k < 9; ++k)
      to_inner_(static_cast<int>(k / 3), static_cast<int>(k % 3)) =
          F::load(poses.to_inner[k].data() + from);
  }

  const ShapeDefinition<Lane<F>>& definition() const { return definition_; }
  const Vec3<F>& centre() const { return centre_; }
  const Mat3<F>* linear_to_inner() const { return are_turned_ ? &to_inner_ : nullptr; }

 private:
  const ShapeDefinition<Lane<F>>& definition_;
  Vec3<F> centre_;
  Mat3<F> to_inner_;
  bool are_turned_;
};

}  // namespace minkray
