// SPDX-License-Identifier: MIT
// Finds where a line enters a ball around the origin.
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

}  // namespace minkray::exact
