// SPDX-License-Identifier: MIT
// Finds where a line enters a box: where the line enters the last of the box's three slabs.
#pragma once

#include "core/model/facet_plane.h"

namespace minkray {

template <class W, class Core>
requires(declared_by<Core>.slabs) struct Facets<W, Core> {
  using T = Lane<W>;
  static constexpr bool some = true;
  static bool known(const Core&) { return true; }

  /// Returns the slab that the line enters last.
  static EnteredFacet<W> entered(const Core& box, const Vec3<T>&, const Vec3<W>&,
                                 const Vec3<W>& from, const RayFrame<W>& frame) {
    using std::abs;
    using std::copysign;
    const Vec3<W> r = -frame.z;
    const W infinity = W(std::numeric_limits<T>::infinity());
    W last_in = -infinity, first_out = infinity, in_slope = W(1), out_slope = W(1);
    Vec3<W> in_normal = Vec3<W>::Zero(), out_normal = Vec3<W>::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const W h = W(box.half_extents[axis]), slope = abs(r[axis]);
      const W side = copysign(W(1), r[axis]), along = from[axis] * side;
      const Mask<W> crosses = slope > W(0), outside = abs(along) > h;
      const W safe = select(crosses, slope, W(1));
      const W in = select(crosses, W((-h - along) / safe), select(outside, infinity, W(-infinity)));
      const W out = select(crosses, W((h - along) / safe), infinity);
      const W outward = select(crosses, W(-side), copysign(W(1), from[axis]));
      const Mask<W> later = in > last_in, sooner = out < first_out;
      last_in = select(later, in, last_in);
      first_out = select(sooner, out, first_out);
      in_slope = select(later, slope, in_slope);
      out_slope = select(sooner, slope, out_slope);
      for (int k = 0; k < 3; ++k) {
        in_normal[k] = select(later, k == axis ? outward : W(0), in_normal[k]);
        out_normal[k] = select(sooner, k == axis ? side : W(0), out_normal[k]);
      }
    }
    EnteredFacet<W> facet;
    facet.known = Mask<W>(true);
    facet.enters = last_in <= first_out;
    facet.there = {facet.enters, facet.enters, facet.enters};
    facet.height = -last_in;
    facet.normal = in_normal;
    if (!all(facet.enters))
      facet.normal = select<W>(facet.enters, in_normal,
                               unit<W>(Vec3<W>(in_normal * out_slope + out_normal * in_slope)));
    facet.in_shape = facet.normal;
    facet.normal = frame.into(facet.in_shape);
    const Vec3<W> at = from + r * select(abs(last_in) < infinity, last_in, W(0));
    Vec3<W> corner;
    for (int k = 0; k < 3; ++k)
      corner[k] =
          copysign(W(box.half_extents[k]), select(in_normal[k] != W(0), in_normal[k], at[k]));
    facet.corner = frame.into(corner - from);
    for (int k = 0; k < 3; ++k) {
      Vec3<W> other = corner;
      other[k] = -corner[k];
      facet.neighbours[static_cast<std::size_t>(k)] = frame.into(other - from);
    }
    return facet;
  }
};

}  // namespace minkray
