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

  static DeclaredForm rounded(const DeclaredForm& form, double radius) {
    return RoundedFrustumForm::rounded(form, radius);
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
    return enter_between_lids(Nappe<W>(form, form.sizes[3], line, open), form.sizes[2], line);
  }
};

}  // namespace minkray::exact
