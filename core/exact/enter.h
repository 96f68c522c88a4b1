// SPDX-License-Identifier: MIT
// Finds where a line enters the closed form of a shape: one function for all kinds of closed forms.
#pragma once

#include "core/exact/box.h"
#include "core/exact/capsule.h"
#include "core/exact/cut_cylinder.h"
#include "core/exact/cylinder.h"
#include "core/exact/form.h"
#include "core/exact/frustum.h"
#include "core/exact/rounded_box.h"
#include "core/exact/tapered_capsule.h"
#include "core/exact/turned_capsule.h"
#include "core/polytope/polytope.h"

namespace minkray::exact {

/// Handles the kinds of forms that `enter` does not inline. Inlining these as well would take
/// registers from the other kinds: it made casts at spheres a fifth slower.
template <class W>
[[gnu::noinline]] Entry<W> enter_out_of_line(const Form& form, const Line<W>& line,
                                             const Mask<W>& open) {
  switch (form.kind) {
    case FormKind::cut_cylinder:
      return enter_cut_cylinder(form.sizes, form.R, line, open);
    case FormKind::segment:
      return enter_turned_capsule(form.sizes, line, open);
    case FormKind::polytope:
      return enter_polytope(*form.polytope, line, open);
    default:
      return {};
  }
}

/// Finds where the line, given in the form's frame, enters the form. Results are valid only in
/// `open` lanes.
template <class W>
[[gnu::always_inline]] inline Entry<W> enter(const Form& form, const Line<W>& line,
                                             const Mask<W>& open) {
  const auto& a = form.sizes;
  switch (form.kind) {
    case FormKind::ball:
      return enter_ball(a[0], line, open);
    case FormKind::box:
      return enter_box(a, line, open);
    case FormKind::rounded_box:
      return enter_rounded_box(a, line, open);
    case FormKind::capsule:
      return enter_capsule(a[0], a[1], line, open);
    case FormKind::tapered_capsule:
      return enter_tapered_capsule(a[0], a[1], a[2], form.slope, form.sine, a[3], form.R, line,
                                   open);
    case FormKind::cylinder:
      return enter_cylinder(a[0], a[1], line, open);
    case FormKind::frustum:
      return enter_frustum(form.slope, form.sine, a[2], a[3], form.R, line, open);
    default:
      return enter_out_of_line(form, line, open);
  }
}

}  // namespace minkray::exact
