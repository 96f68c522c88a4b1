// SPDX-License-Identifier: MIT
// Closed form of tapered capsules along the z axis, with the larger ball below: a line enters on
// the cone that touches both balls or, if it enters the cone beyond an end, on the ball at that
// end. Line and Entry are in core/query/line.h.
#pragma once

#include "core/exact/ball.h"
#include "core/exact/capsule.h"
#include "core/exact/nappe.h"

namespace minkray::exact {

/// Sizes: the balls' radii at -z and +z, half the distance of their centres. After preparation, the
/// lower ball is the larger one, and the fourth size is the height of the apex.
struct TaperedCapsuleForm : FormDefaults {
  static constexpr FormKind kind{6};
  static constexpr bool is_inlined = true, is_round = true;
  static constexpr Lanes lanes = Lanes::sizes;

  static DeclaredForm of(const TaperedCapsule& shape) {
    return {{shape.radii[0], shape.radii[1], shape.half_height}};
  }

  static DeclaredForm rounded(DeclaredForm form, double radius) {
    form.sizes[0] += radius;
    form.sizes[1] += radius;
    return form;
  }

  static Form prepared(Form form) {
    larger_end_below(form);
    const double lower = form.sizes[0], upper = form.sizes[1], half_height = form.sizes[2];
    if (lower == upper) {
      form.kind = CapsuleForm::kind;
      form.sizes = {lower, half_height};
      return CapsuleForm::prepared(form);
    }
    if (!(half_height > 0)) return {};
    const double narrows = (lower - upper) / (2 * half_height);
    if (!(narrows < tolerance::tapered_steepest) ||
        !(upper > tolerance::tapered_least_ball * lower))
      return {};
    form.sine = narrows;
    form.slope = narrows / std::sqrt(1 - narrows * narrows);
    form.R = half_height + lower;
    return with_apex(form, narrows);
  }

  static double least_radius(const Form& form) { return std::min(form.sizes[0], form.sizes[1]); }

  template <class W, class Numbers>
  [[gnu::always_inline]] static Entry<W> enter(const Numbers& form, const Line<W>& line,
                                               const Mask<W>& open) {
    const auto &lower = form.sizes[0], &upper = form.sizes[1], &half_height = form.sizes[2],
               &apex = form.sizes[3];
    const Vec3<W>&s = line.s, &d = line.d;
    Entry<W> entry;
    const Nappe<W> round(form, apex, line, open);
    entry.miss = round.miss;
    if (any(round.miss)) entry.normal = round.separating(line);
    if (!any(round.hit)) return entry;
    // Heights of the circles where the cone touches the balls.
    const W low(-half_height + lower * form.sine), high(half_height + upper * form.sine);
    const W z = s.z() + round.in * d.z();
    const Mask<W> below = z<low, above = z> high;
    const Mask<W> by_side = round.hit & !below & !above;
    entry.hit = by_side;
    entry.t = round.in;
    entry.e = W(2) * round.in_e;
    if (any(by_side)) entry.normal = select<W>(by_side, round.normal_in(line), entry.normal);
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
      const Mask<W> passes = enter_end(entry, by_end, r, p, line) & round.is_above(line);
      if (any(passes)) entry.normal = select<W>(passes, round.separating(line), entry.normal);
    }
    entry.hit &= !unsure;
    return entry;
  }
};

}  // namespace minkray::exact
