// SPDX-License-Identifier: MIT
// Where a line enters a ball around the origin.
#pragma once

#include "core/exact/line.h"

namespace minkray::exact {

/// How near to tangent: r^2 - |x|^2 of the closest point x is known to 2 r |dx| and a few roundings
/// of r^2, less than this times E r.
inline constexpr double tangent_margin = 4;

template <class W, class S>
[[gnu::always_inline]] inline Entry<W> enter_ball(const S& size, const Line<W>& line,
                                                  const Mask<W>& open) {
  using std::max;
  using std::sqrt;
  const W r(size);
  Entry<W> entry;
  const W h2 = r * r - line.s.squaredNorm(), margin = W(tangent_margin) * r * line.E;
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
