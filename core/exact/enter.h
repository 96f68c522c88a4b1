// SPDX-License-Identifier: MIT
// Finds where a line enters the closed form of a shape: one function for all kinds of closed forms.
#pragma once

#include "core/exact/forms.h"

namespace minkray::exact {

/// Finds where the line enters the form, if its kind is in the list and F::is_inlined is `inlined`.
/// Returns other() for other kinds.
template <bool inlined, class W, class Other, class F, class... Rest>
[[gnu::always_inline]] inline Entry<W> enter_one_of(const Form& form, const Line<W>& line,
                                                    const Mask<W>& open, const Other& other,
                                                    FormList<F, Rest...>) {
  if constexpr (F::is_inlined == inlined)
    if (form.kind == F::kind) return F::enter(form, line, open);
  if constexpr (sizeof...(Rest) > 0)
    return enter_one_of<inlined>(form, line, open, other, FormList<Rest...>());
  else
    return other();
}

/// Handles the kinds of forms that `enter` does not inline. Inlining these as well would take
/// registers from the other kinds: it made casts at spheres a fifth slower.
template <class W>
[[gnu::noinline]] Entry<W> enter_out_of_line(const Form& form, const Line<W>& line,
                                             const Mask<W>& open) {
  return enter_one_of<false>(
      form, line, open, [] { return Entry<W>(); }, Forms());
}

/// Finds where the line, given in the form's frame, enters the form. Results are valid only in
/// `open` lanes.
template <class W>
[[gnu::always_inline]] inline Entry<W> enter(const Form& form, const Line<W>& line,
                                             const Mask<W>& open) {
  return enter_one_of<true>(
      form, line, open, [&] { return enter_out_of_line<W>(form, line, open); }, Forms());
}

}  // namespace minkray::exact
