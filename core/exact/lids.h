// SPDX-License-Identifier: MIT
// Finds where a line enters the part of a round side between two planes (the lids of cylinders and
// frustums). The side is a Mantle or a Nappe. Line and Entry are in core/query/line.h.
#pragma once

#include "core/query/line.h"

namespace minkray::exact {

/// The lids are at heights -half_height and half_height.
template <template <class> class Side, class W, class S>
[[gnu::always_inline]] inline Entry<W> enter_between_lids(const Side<W>& side, const S& half_height,
                                                          const Line<W>& line) {
  using std::max;
  using std::min;
  Entry<W> entry;
  entry.miss = side.miss;
  if (any(side.miss)) entry.normal = side.separating(line);
  if (!any(side.hit)) return entry;
  const Slab<W> flat(line.s.z(), line.d.z(), half_height, line.E);
  const W t = max(side.in, flat.in);
  const W lo = max(W(side.in - side.in_e), W(flat.in - flat.e));
  const W hi = max(W(side.in + side.in_e), W(flat.in + flat.e));
  const W out_lo = min(W(side.out - side.out_e), W(flat.out - flat.e));
  const W out_hi = min(W(side.out + side.out_e), W(flat.out + flat.e));
  entry.hit = side.hit & (hi <= out_lo);
  const Mask<W> passes = side.hit & (lo > out_hi);
  entry.t = t;
  entry.e = max(hi - t, t - lo);
  const Vec3<W> lid(W(0), W(0), W(-flat.facing)), round = side.normal_in(line);
  const Vec3<W> entered = select<W>(side.in >= flat.in, round, lid);
  entry.normal = select<W>(side.hit, entered, entry.normal);
  if (any(passes)) {
    // The planes that prove the miss, chosen by the bounds.
    const Vec3<W> in = select<W>(side.in - side.in_e >= flat.in - flat.e, round, lid);
    const Vec3<W> out =
        select<W>(side.out + side.out_e <= flat.out + flat.e, side.normal_out(line), Vec3<W>(-lid));
    const Vec3<W> separating =
        select<W>(side.is_above(line), side.separating(line), between(in, out, line.d));
    entry.normal = select<W>(passes, separating, entry.normal);
    entry.miss |= passes;
  }
  return entry;
}

}  // namespace minkray::exact
