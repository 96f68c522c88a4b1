// SPDX-License-Identifier: MIT
// Finds where a line enters a frustum around the z axis, with its larger disk below. The frustum is
// the part of an infinite cone between two planes. A cone is a frustum whose upper disk is a point.
// `slope`, `sine`, `apex` and R are those of Form (core/exact/form.h); Line and Entry are in
// core/query/line.h.
#pragma once

#include "core/exact/nappe.h"

namespace minkray::exact {

template <class W, class S>
[[gnu::always_inline]] inline Entry<W> enter_frustum(const S& slope, const S& sine,
                                                     const S& half_height, const S& apex,
                                                     const S& R, const Line<W>& line,
                                                     const Mask<W>& open) {
  using std::max;
  using std::min;
  Entry<W> entry;
  const Nappe<W> round(slope, apex, R, line, open);
  entry.miss = round.miss;
  if (any(round.miss)) entry.normal = round.separating(line);
  if (!any(round.hit)) return entry;
  const Slab<W> flat(line.s.z(), line.d.z(), half_height, line.E);
  const W t = max(round.in, flat.in);
  const W lo = max(W(round.in - round.in_e), W(flat.in - flat.e));
  const W hi = max(W(round.in + round.in_e), W(flat.in + flat.e));
  const W out_lo = min(W(round.out - round.out_e), W(flat.out - flat.e));
  const W out_hi = min(W(round.out + round.out_e), W(flat.out + flat.e));
  entry.hit = round.hit & (hi <= out_lo);
  const Mask<W> passes = round.hit & (lo > out_hi);
  entry.t = t;
  entry.e = max(hi - t, t - lo);
  const Vec3<W> lid(W(0), W(0), W(-flat.facing));
  const Vec3<W> side = round.normal(round.in, sine, line);
  const Vec3<W> entered = select<W>(round.in >= flat.in, side, lid);
  entry.normal = select<W>(round.hit, entered, entry.normal);
  if (any(passes)) {
    // The planes that prove the miss, chosen by the bounds.
    const Vec3<W> in = select<W>(round.in - round.in_e >= flat.in - flat.e, side, lid);
    const Vec3<W> out = select<W>(round.out + round.out_e <= flat.out + flat.e,
                                  round.normal(round.out, sine, line), Vec3<W>(-lid));
    const Vec3<W> separating =
        select<W>(round.is_above(apex, line), round.separating(line), between(in, out, line.d));
    entry.normal = select<W>(passes, separating, entry.normal);
    entry.miss |= passes;
  }
  return entry;
}

}  // namespace minkray::exact
