// SPDX-License-Identifier: MIT
// Finds where a line enters and leaves an infinite cylinder around the z axis (the mantle of
// cylinders and capsules).
#pragma once

#include "core/exact/ball.h"

namespace minkray::exact {

template <class W>
struct Mantle {
  Mask<W> hit, miss;  ///< neither: undecided
  W in, out, e;       ///< parameters of entry and exit, and the error of both
  W x, y;             ///< point of the line closest to the axis
  W half;             ///< parameter difference from that point to the entry or exit

  template <class S>
  Mantle(const S& size, const Line<W>& line, const Mask<W>& open) {
    using std::max;
    using std::sqrt;
    const W r(size);
    const Vec3<W>&s = line.s, &d = line.d;
    const W across = d.x() * d.x() + d.y() * d.y();
    const Mask<W> along = across < line.parallel;
    const W inv = W(1) / max(across, line.parallel);
    const W k = select(along, W(0), W(-(s.x() * d.x() + s.y() * d.y()) * inv));
    x = s.x() + k * d.x();
    y = s.y() + k * d.y();
    const W h2 = r * r - (x * x + y * y), margin = W(tolerance::form_tangent) * r * line.E;
    hit = open & (h2 > margin);
    miss = open & (h2 < -margin);
    half = sqrt(max(h2, margin) * inv);
    in = k - half;
    out = k + half;
    e = line.E * r * inv / half;
  }
  /// Outward unit normal where the line enters (sign = -1) or leaves (sign = 1).
  template <class S>
  Vec3<W> normal(int sign, const S& r, const Line<W>& line) const {
    const W at = half * W(Lane<W>(sign)), per_r = W(1) / W(r);
    return {(x + line.d.x() * at) * per_r, (y + line.d.y() * at) * per_r, W(0)};
  }
};

}  // namespace minkray::exact
