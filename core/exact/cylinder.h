// SPDX-License-Identifier: MIT
// Closed form of cylinders around the z axis: the part of an infinite cylinder between two planes.
// Line and Entry are in core/query/line.h; results are valid only in `open` lanes.
#pragma once

#include "core/exact/lids.h"
#include "core/exact/mantle.h"
#include "core/exact/rounded_frustum.h"

namespace minkray::exact {

/// Sizes: radius, half height.
struct CylinderForm : FormDefaults {
  static constexpr FormKind kind{4};
  static constexpr bool is_inlined = true;
  static constexpr Lanes lanes = Lanes::sizes;

  static DeclaredForm of(const Cylinder& shape) { return {{shape.radius, shape.half_height}}; }

  static DeclaredForm rounded(const DeclaredForm& form, double radius) {
    const double r = form.sizes[0], half_height = form.sizes[1];
    return RoundedFrustumForm::rounded({{r, r, half_height}}, radius);
  }

  static Form prepared(Form form) {
    form.R = std::hypot(form.sizes[0], form.sizes[1]);
    return form;
  }

  static double least_radius(const Form& form) { return form.sizes[0]; }

  template <class W, class Numbers>
  [[gnu::always_inline]] static Entry<W> enter(const Numbers& form, const Line<W>& line,
                                               const Mask<W>& open) {
    return enter_between_lids(Mantle<W>(form.sizes[0], line, open), form.sizes[1], line);
  }
};

}  // namespace minkray::exact
