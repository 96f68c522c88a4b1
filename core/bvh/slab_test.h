// SPDX-License-Identifier: MIT
// The padded slab tests of core/bvh/slab_ray.h for several boxes in lanes. The lanes' type, and so
// the instruction set, is part of all names (core/math/wide.h).
#pragma once

#include "core/bvh/bvh.h"
#include "core/bvh/slab_ray.h"
#include "core/math/wide.h"

namespace minkray {

/// Parameters at which the ray meets the near and far planes of an axis, in lanes. A ray within a
/// plane gives 0 * infinity = NaN. The order of operands in max and min drops NaN, so such a plane
/// does not limit the ray.
template <class Lanes>
struct SlabInterval {
  Lanes enter, leave;

  void meet(const Lanes& near_plane, const Lanes& far_plane, const Lanes& origin_near,
            const Lanes& origin_far, const Lanes& inverse_near, const Lanes& inverse_far) {
    enter = max(enter, Lanes((near_plane - origin_near) * inverse_near));
    leave = min(leave, Lanes((far_plane - origin_far) * inverse_far));
  }
  Mask<Lanes> is_met() const { return enter <= leave * Lanes(slab_padding) + Lanes(slab_tiny); }
};

/// Returns one bit per box of the node: 1 if the ray meets the box up to t_max. Writes the
/// parameters of entry.
template <class Lanes>
std::uint32_t boxes_met(const BvhNode& node, const SlabNumbers& ray, float t_max,
                        float (&enters)[bvh_width]) {
  std::uint32_t met = 0;
  for (int from = 0; from < bvh_width; from += LaneOf<Lanes>::count) {
    SlabInterval<Lanes> t{Lanes(0.0f), Lanes(t_max)};
    for (int axis = 0; axis < 3; ++axis)
      t.meet(Lanes::load(node.planes[ray.near[axis]][axis] + from),
             Lanes::load(node.planes[1 - ray.near[axis]][axis] + from),
             Lanes(ray.origin_near[axis]), Lanes(ray.origin_far[axis]),
             Lanes(ray.inverse_near[axis]), Lanes(ray.inverse_far[axis]));
    t.enter.store(enters + from);
    met |= lane_bits(t.is_met()) << from;
  }
  return met;
}

}  // namespace minkray
