// SPDX-License-Identifier: MIT
// Closed form of boxes: where a line enters a box around the origin. A slab is the space between
// two opposite faces. The line enters the box where it enters the last of the three slabs, if it
// has left no slab before. Line and Entry are in core/query/line.h; results are valid only in
// `open` lanes.
#pragma once

#include "core/exact/rounded_box.h"
#include "core/query/line.h"

namespace minkray::exact {

/// Sizes: three half extents.
struct BoxForm : FormDefaults {
  static constexpr FormKind kind{3};
  static constexpr bool is_inlined = true;
  static constexpr Lanes lanes = Lanes::sizes;

  static DeclaredForm of(const Box& shape) {
    const Vec3<double>& h = shape.half_extents;
    return {{h[0], h[1], h[2]}};
  }

  static DeclaredForm rounded(DeclaredForm form, double radius) {
    form.kind = RoundedBoxForm::kind;
    form.sizes[3] = radius;
    return form;
  }

  static Form prepared(Form form) {
    const FormSizes& h = form.sizes;
    form.R = Vec3<double>(h[0], h[1], h[2]).norm();
    return form;
  }

  template <class W, class Numbers>
  [[gnu::always_inline]] static Entry<W> enter(const Numbers& form, const Line<W>& line,
                                               const Mask<W>& open) {
    const auto& h = form.sizes;
    using std::max;
    using std::min;
    const Vec3<W>&s = line.s, &d = line.d;
    const Slab<W> x(s.x(), d.x(), h[0], line.E), y(s.y(), d.y(), h[1], line.E),
        z(s.z(), d.z(), h[2], line.E);
    const W t = max(max(x.in, y.in), z.in);
    const W lo = max(max(W(x.in - x.e), W(y.in - y.e)), W(z.in - z.e));
    const W hi = max(max(W(x.in + x.e), W(y.in + y.e)), W(z.in + z.e));
    const W out_lo = min(min(W(x.out - x.e), W(y.out - y.e)), W(z.out - z.e));
    const W out_hi = min(min(W(x.out + x.e), W(y.out + y.e)), W(z.out + z.e));
    Entry<W> entry;
    entry.hit = open & (hi <= out_lo);
    entry.miss = open & (lo > out_hi);
    entry.t = t;
    entry.e = max(hi - t, t - lo);
    const auto axis = [&](const Mask<W>& by_x, const Mask<W>& by_y) -> Vec3<W> {
      const W other = select(by_x | by_y, W(0), z.facing);
      return {select(by_x, x.facing, W(0)), select(by_y & !by_x, y.facing, W(0)), other};
    };
    entry.normal = -axis(x.in == t, y.in == t);
    if (any(entry.miss)) {
      // Two planes prove the miss: the last one that the line enters and the first one that it
      // leaves.
      const Vec3<W> entered = -axis(x.in - x.e == lo, y.in - y.e == lo);
      const Vec3<W> left = axis(x.out + x.e == out_hi, y.out + y.e == out_hi);
      entry.normal = select<W>(entry.miss, between(entered, left, d), entry.normal);
    }
    return entry;
  }
};

}  // namespace minkray::exact
