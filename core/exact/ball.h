// SPDX-License-Identifier: MIT
// Finds where a line enters a ball around the origin. Line and Entry are in core/query/line.h;
// results are valid only in `open` lanes.
#pragma once

#include "core/query/line.h"
#include "core/query/tolerances.h"

namespace minkray::exact {

template <class W, class S>
[[gnu::always_inline]] inline Entry<W> enter_ball(const S& size, const Line<W>& line,
                                                  const Mask<W>& open) {
  using std::max;
  using std::sqrt;
  const W r(size);
  Entry<W> entry;
  const W h2 = r * r - line.s.squaredNorm(), margin = W(tolerance::form_tangent) * r * line.E;
  entry.hit = open & (h2 > margin);
  entry.miss = open & (h2 < -margin);
  entry.normal = line.s;
  if (!any(entry.hit)) return entry;
  const W half = sqrt(max(h2, margin) * line.inv);
  entry.t = -half;
  entry.e = line.E * r * line.inv / half;
  entry.normal = select<W>(entry.hit, Vec3<W>((line.s - line.d * half) * (W(1) / r)), entry.normal);
  return entry;
}

/// Finds where the line enters the ball at one end of a shape, in the lanes `by_end`, and updates
/// `entry` there. `p` is the line's point s relative to the ball's centre. Returns the lanes whose
/// line misses the ball.
template <class W>
[[gnu::always_inline]] inline Mask<W> enter_end(Entry<W>& entry, const Mask<W>& by_end, const W& r,
                                                const Vec3<W>& p, const Line<W>& line) {
  using std::max;
  using std::sqrt;
  const Vec3<W>& d = line.d;
  const W k = -p.dot(d) * line.inv;
  const Vec3<W> x = p + d * k;
  const W h2 = r * r - x.squaredNorm(), margin = W(tolerance::form_tangent) * r * line.E;
  const Mask<W> hit = by_end & (h2 > margin), miss = by_end & (h2 < -margin);
  const W half = sqrt(max(h2, margin) * line.inv);
  entry.hit |= hit;
  entry.miss |= miss;
  entry.t = select(hit, W(k - half), entry.t);
  entry.e = select(hit, W(W(2) * r * line.E * line.inv / half), entry.e);
  const Vec3<W> outward = select<W>(hit, Vec3<W>((x - d * half) * (W(1) / r)), x);
  entry.normal = select<W>(hit | miss, outward, entry.normal);
  return miss;
}

}  // namespace minkray::exact
