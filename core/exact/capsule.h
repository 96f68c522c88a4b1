// SPDX-License-Identifier: MIT
// Closed form of capsules along the z axis: a line enters on the cylinder or, if it enters the
// infinite cylinder beyond an end, on the ball at that end. Line and Entry are in
// core/query/line.h; results are valid only in `open` lanes.
#pragma once

#include "core/exact/ball.h"
#include "core/exact/mantle.h"

namespace minkray::exact {

/// Sizes: radius, half height.
struct CapsuleForm : FormDefaults {
  static constexpr FormKind kind{2};
  static constexpr bool is_inlined = true, is_round = true;
  static constexpr Lanes lanes = Lanes::sizes;

  static DeclaredForm of(const Capsule& shape) { return {{shape.radius, shape.half_height}}; }

  static DeclaredForm rounded(DeclaredForm form, double radius) {
    form.sizes[0] += radius;
    return form;
  }

  static Form prepared(Form form) {
    form.R = form.sizes[0] + form.sizes[1];
    return form;
  }

  static double least_radius(const Form& form) { return form.sizes[0]; }

  template <class W, class Numbers>
  [[gnu::always_inline]] static Entry<W> enter(const Numbers& form, const Line<W>& line,
                                               const Mask<W>& open) {
    const auto& half_height = form.sizes[1];
    using std::abs;
    using std::copysign;
    const W r(form.sizes[0]);
    const Vec3<W>&s = line.s, &d = line.d;
    Entry<W> entry;
    const Mantle<W> round(r, line, open);
    entry.miss = round.miss;
    entry.normal = {round.x, round.y, W(0)};
    if (!any(round.hit)) return entry;
    const W z = s.z() + round.in * d.z();
    const W beyond = abs(z) - W(half_height);
    const Mask<W> by_side = round.hit & (beyond <= W(0));
    entry.hit = by_side;
    entry.t = round.in;
    entry.e = W(2) * round.in_e;
    entry.normal = select<W>(by_side, round.normal_in(line), entry.normal);
    // At a distance w from the circle where cylinder and ball meet, their formulas differ by w^2 /
    // 2r across the ray. So the result is undecided only if w^2 > E r and the line enters within w
    // of that circle.
    const W w2 = entry.e * entry.e * line.dd;
    const Mask<W> unsure = (w2 > r * line.E) & (beyond * beyond < w2);

    const Mask<W> by_end = round.hit & !by_side & !unsure;
    if (any(by_end)) {
      const Vec3<W> p(s.x(), s.y(), s.z() - copysign(W(half_height), z));
      enter_end(entry, by_end, r, p, line);
    }
    entry.hit &= !unsure;
    return entry;
  }
};

}  // namespace minkray::exact
