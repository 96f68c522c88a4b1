// SPDX-License-Identifier: MIT
// The list of all closed forms. Each is described by a struct F with these members, and with those
// of FormDefaults (form.h) that differ:
// F::kind, the position in the list; F::of(shape), the sizes for each kind of shape with this form;
// F::prepared(form), which computes R and other numbers of a Form from its sizes, and may return
// another kind; F::enter(form, line, open), where lines enter.
#pragma once

#include <cstddef>

#include "core/exact/ball.h"
#include "core/exact/box.h"
#include "core/exact/capsule.h"
#include "core/exact/cut_cylinder.h"
#include "core/exact/cylinder.h"
#include "core/exact/frustum.h"
#include "core/exact/polytope_form.h"
#include "core/exact/rounded_box.h"
#include "core/exact/rounded_frustum.h"
#include "core/exact/tapered_capsule.h"
#include "core/exact/turned_capsule.h"

namespace minkray::exact {

template <class... F>
struct FormList {
  static constexpr std::size_t count = sizeof...(F);
  /// True if each form's kind is its position in the list, from 1.
  static constexpr bool is_in_order() {
    std::size_t at = 0;
    return ((static_cast<std::size_t>(F::kind) == ++at) && ...);
  }
};

/// Casts compare kinds in this order, so the most common forms come first.
using Forms = FormList<  //
    BallForm,            //
    CapsuleForm,         //
    BoxForm,             //
    CylinderForm,        //
    RoundedBoxForm,      //
    TaperedCapsuleForm,  //
    FrustumForm,         //
    CutCylinderForm,     //
    RoundedFrustumForm,  //
    TurnedCapsuleForm,   //
    PolytopeForm>;

static_assert(Forms::is_in_order() && Forms::count < form_kinds);

/// Returns work.operator()<F>() for the form of this kind; a default result for `none`.
template <class F, class... Rest, class Work>
[[gnu::always_inline]] inline auto with_form(FormKind kind, const Work& work, FormList<F, Rest...>)
    -> decltype(work.template operator()<F>()) {
  if (kind == F::kind) return work.template operator()<F>();
  if constexpr (sizeof...(Rest) > 0)
    return with_form(kind, work, FormList<Rest...>());
  else
    return decltype(work.template operator()<F>())();
}

template <class Work>
[[gnu::always_inline]] inline auto with_form(FormKind kind, const Work& work) {
  return with_form(kind, work, Forms());
}

}  // namespace minkray::exact
