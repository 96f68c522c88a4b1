// SPDX-License-Identifier: MIT
// Closed form of cylinders around the z axis: the part of an infinite cylinder between two planes.
// Line and Entry are in core/query/line.h; results are valid only in `open` lanes.
#pragma once

#include "core/exact/mantle.h"

namespace minkray::exact {

/// Sizes: radius, half height.
struct CylinderForm : FormDefaults {
  static constexpr FormKind kind{4};
  static constexpr bool is_inlined = true;
  static constexpr Lanes lanes = Lanes::sizes;

  static DeclaredForm of(const Cylinder& shape) { return {{shape.radius, shape.half_height}}; }

  static Form prepared(Form form) {
    form.R = std::hypot(form.sizes[0], form.sizes[1]);
    return form;
  }

  static double least_radius(const Form& form) { return form.sizes[0]; }

  template <class W, class Numbers>
  [[gnu::always_inline]] static Entry<W> enter(const Numbers& form, const Line<W>& line,
                                               const Mask<W>& open) {
    const auto &r = form.sizes[0], &half_height = form.sizes[1];
    using std::max;
    using std::min;
    Entry<W> entry;
    const Mantle<W> round(r, line, open);
    entry.miss = round.miss;
    entry.normal = {round.x, round.y, W(0)};
    if (!any(round.hit)) return entry;
    const Slab<W> flat(line.s.z(), line.d.z(), half_height, line.E);
    const W t = max(round.in, flat.in);
    const W lo = max(W(round.in - round.e), W(flat.in - flat.e));
    const W hi = max(W(round.in + round.e), W(flat.in + flat.e));
    const W out_lo = min(W(round.out - round.e), W(flat.out - flat.e));
    const W out_hi = min(W(round.out + round.e), W(flat.out + flat.e));
    entry.hit = round.hit & (hi <= out_lo);
    const Mask<W> passes = round.hit & (lo > out_hi);
    entry.t = t;
    entry.e = max(hi - t, t - lo);
    const Mask<W> by_side = round.in >= flat.in;
    const Vec3<W> lid(W(0), W(0), W(-flat.facing));
    const Vec3<W> side = round.normal(-1, r, line);
    entry.normal = select<W>(round.hit, select<W>(by_side, side, lid), entry.normal);
    if (any(passes)) {
      // The planes that prove the miss, chosen by the bounds.
      const Vec3<W> entered = select<W>(round.in - round.e >= flat.in - flat.e, side, lid);
      const Vec3<W> left = select<W>(round.out + round.e <= flat.out + flat.e,
                                     round.normal(1, r, line), Vec3<W>(-lid));
      entry.normal = select<W>(passes, between(entered, left, line.d), entry.normal);
      entry.miss |= passes;
    }
    return entry;
  }
};

}  // namespace minkray::exact
