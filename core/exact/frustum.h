// SPDX-License-Identifier: MIT
// Closed form of frustums around the z axis, with the larger disk below: the part of an infinite
// cone between two planes. A cone is a frustum whose upper disk is a point. Line and Entry are in
// core/query/line.h.
#pragma once

#include "core/exact/cylinder.h"
#include "core/exact/nappe.h"

namespace minkray::exact {

/// Sizes: the disks' radii at -z and +z, half height. After preparation, the lower disk is the
/// larger one, and the fourth size is the height of the apex.
struct FrustumForm : FormDefaults {
  static constexpr FormKind kind{7};
  static constexpr bool is_inlined = true;
  static constexpr Lanes lanes = Lanes::sizes;

  static DeclaredForm of(const Cone& shape) { return {{shape.radius, 0, shape.half_height}}; }
  static DeclaredForm of(const Frustum& shape) {
    return {{shape.radii[0], shape.radii[1], shape.half_height}};
  }

  static Form prepared(Form form) {
    larger_end_below(form);
    const double lower = form.sizes[0], upper = form.sizes[1], half_height = form.sizes[2];
    if (lower == upper) {
      form.kind = CylinderForm::kind;
      form.sizes = {lower, half_height};
      return CylinderForm::prepared(form);
    }
    if (!(half_height > 0)) return {};
    const double narrows = (lower - upper) / (2 * half_height);
    form.slope = narrows;
    form.sine = narrows / std::sqrt(1 + narrows * narrows);
    form.R = std::hypot(half_height, lower);
    return with_apex(form, narrows);
  }

  template <class W, class Numbers>
  [[gnu::always_inline]] static Entry<W> enter(const Numbers& form, const Line<W>& line,
                                               const Mask<W>& open) {
    const auto &half_height = form.sizes[2], &apex = form.sizes[3];
    using std::max;
    using std::min;
    Entry<W> entry;
    const Nappe<W> round(form.slope, apex, form.R, line, open);
    entry.miss = round.miss;
    if (any(round.miss)) entry.normal = round.separating(line);
    if (!any(round.hit)) return entry;
    const Slab<W> flat(line.s.z(), line.d.z(), half_height, line.E);
    const W t = max(round.in, flat.in);
    const W lo = max(W(round.in - round.in_e), W(flat.in - flat.e));
    const W hi = max(W(round.in + round.in_e), W(flat.in + flat.e));
    const W out_lo = min(W(round.out - round.out_e), W(flat.out - flat.e));
    const W out_hi = min(W(round.out + round.out_e), W(flat.out + flat.e));
    entry.hit = round.hit & (hi <= out_lo);
    const Mask<W> passes = round.hit & (lo > out_hi);
    entry.t = t;
    entry.e = max(hi - t, t - lo);
    const Vec3<W> lid(W(0), W(0), W(-flat.facing));
    const Vec3<W> side = round.normal(round.in, form.sine, line);
    const Vec3<W> entered = select<W>(round.in >= flat.in, side, lid);
    entry.normal = select<W>(round.hit, entered, entry.normal);
    if (any(passes)) {
      // The planes that prove the miss, chosen by the bounds.
      const Vec3<W> in = select<W>(round.in - round.in_e >= flat.in - flat.e, side, lid);
      const Vec3<W> out = select<W>(round.out + round.out_e <= flat.out + flat.e,
                                    round.normal(round.out, form.sine, line), Vec3<W>(-lid));
      const Vec3<W> separating =
          select<W>(round.is_above(apex, line), round.separating(line), between(in, out, line.d));
      entry.normal = select<W>(passes, separating, entry.normal);
      entry.miss |= passes;
    }
    return entry;
  }
};

}  // namespace minkray::exact
