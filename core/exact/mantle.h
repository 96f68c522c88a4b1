// SPDX-License-Identifier: MIT
// Finds where a line enters and leaves an infinite cylinder around the z axis (the mantle of
// cylinders and capsules).
#pragma once

#include "core/exact/ball.h"

namespace minkray::exact {

template <class W>
struct Mantle {
  Mask<W> hit, miss;       ///< neither: undecided
  W in, in_e, out, out_e;  ///< parameters of entry and exit, and their errors
  W r;
  W x, y;  ///< point of the line closest to the axis
  W half;  ///< parameter difference from that point to the entry or exit

  template <class S>
  Mantle(const S& radius, const Line<W>& line, const Mask<W>& open) : r(radius) {
    using std::max;
    using std::sqrt;
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
    in_e = out_e = line.E * r * inv / half;
  }

  /// Outward unit normals where the line enters and leaves.
  [[gnu::always_inline]] Vec3<W> normal_in(const Line<W>& line) const {
    return normal(-half, line);
  }
  [[gnu::always_inline]] Vec3<W> normal_out(const Line<W>& line) const {
    return normal(half, line);
  }

  /// For a line that misses: the normal of the plane that touches the cylinder.
  [[gnu::always_inline]] Vec3<W> separating(const Line<W>&) const { return {x, y, W(0)}; }

  /// Unlike a cone, a cylinder has no part that does not belong to the form.
  Mask<W> is_above(const Line<W>&) const { return Mask<W>(false); }

 private:
  [[gnu::always_inline]] Vec3<W> normal(const W& at, const Line<W>& line) const {
    const W per_r = W(1) / r;
    return {(x + line.d.x() * at) * per_r, (y + line.d.y() * at) * per_r, W(0)};
  }
};

}  // namespace minkray::exact
