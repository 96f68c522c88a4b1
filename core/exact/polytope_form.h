// SPDX-License-Identifier: MIT
// Closed form of hulls and triangles, and of their sums with a ball (core/polytope/polytope.h).
#pragma once

#include "core/exact/form.h"
#include "core/polytope/polytope.h"

namespace minkray::exact {

/// Sizes, for triangles: three corners, rounding radius. Hulls have none.
struct PolytopeForm : FormDefaults {
  static constexpr FormKind kind{11};
  static constexpr Lanes lanes = Lanes::planes;

  /// The form of triangles is for rounded triangles.
  static DeclaredForm of(const Triangle& shape) {
    DeclaredForm form;
    for (std::size_t i = 0; i < 9; ++i)
      form.sizes[i] = shape.points[i / 3][static_cast<int>(i % 3)];
    return form;
  }

  static DeclaredForm rounded(DeclaredForm form, double radius) {
    form.sizes[9] += radius;
    return form;
  }

  static Form prepared(const Form& form) {
    const FormSizes& a = form.sizes;
    std::array<Vec3<double>, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = Vec3<double>(a[3 * i], a[3 * i + 1], a[3 * i + 2]) - form.offset;
    return of(Polytope::of(corners, a[9]));
  }

  /// The polytope's middle must be the bounding ball's centre. Returns no form for null.
  static Form of(std::shared_ptr<const Polytope> polytope) {
    Form form;
    if (!polytope) return form;
    form.kind = kind;
    form.R = polytope->radius();
    form.polytope = std::move(polytope);
    return form;
  }

  template <class W>
  static Entry<W> enter(const Form& form, const Line<W>& line, const Mask<W>& open) {
    return enter_polytope(*form.polytope, line, open);
  }
};

}  // namespace minkray::exact
