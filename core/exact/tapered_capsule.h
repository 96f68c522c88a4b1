// SPDX-License-Identifier: MIT
// Finds where a line enters a tapered capsule along the z axis, with its larger ball below: on the
// cone that touches both balls or, if the line enters the cone beyond an end, on the ball at that
// end. `slope`, `sine`, `apex` and R are those of Form (core/exact/form.h); Line and Entry are in
// core/query/line.h.
#pragma once

#include "core/exact/ball.h"
#include "core/exact/nappe.h"

namespace minkray::exact {

template <class W, class S>
[[gnu::always_inline]] inline Entry<W> enter_tapered_capsule(const S& lower, const S& upper,
                                                             const S& half_height, const S& slope,
                                                             const S& sine, const S& apex,
                                                             const S& R, const Line<W>& line,
                                                             const Mask<W>& open) {
  const Vec3<W>&s = line.s, &d = line.d;
  Entry<W> entry;
  const Nappe<W> round(slope, apex, R, line, open);
  entry.miss = round.miss;
  if (any(round.miss)) entry.normal = round.separating(line);
  if (!any(round.hit)) return entry;
  // Heights of the circles where the cone touches the balls.
  const W low(-half_height + lower * sine), high(half_height + upper * sine);
  const W z = s.z() + round.in * d.z();
  const Mask<W> below = z<low, above = z> high;
  const Mask<W> by_side = round.hit & !below & !above;
  entry.hit = by_side;
  entry.t = round.in;
  entry.e = W(2) * round.in_e;
  if (any(by_side))
    entry.normal = select<W>(by_side, round.normal(round.in, sine, line), entry.normal);
  // Undecided for the same reason as for a capsule (core/exact/capsule.h).
  const W w2 = entry.e * entry.e * line.dd;
  const W from_low = z - low, from_high = z - high;
  const Mask<W> unsure =
      (w2 > W(upper) * line.E) & ((from_low * from_low < w2) | (from_high * from_high < w2));

  const Mask<W> by_end = round.hit & !by_side & !unsure;
  if (any(by_end)) {
    const W r = select(above, W(upper), W(lower));
    const W middle = select(above, W(half_height), W(-half_height));
    const Vec3<W> p(s.x(), s.y(), s.z() - middle);
    const Mask<W> passes = enter_end(entry, by_end, r, p, line) & round.is_above(apex, line);
    if (any(passes)) entry.normal = select<W>(passes, round.separating(line), entry.normal);
  }
  entry.hit &= !unsure;
  return entry;
}

}  // namespace minkray::exact
