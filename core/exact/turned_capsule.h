// SPDX-License-Identifier: MIT
// Finds where a line enters a capsule along any axis: the one along z, after a turn.
#pragma once

#include "core/exact/capsule.h"
#include "core/exact/form.h"

namespace minkray::exact {

/// The form's sizes become radius, half height, and the capsule's own z and x axes. Sizes that were
/// declared are half the way from end to end, and the radius.
Form turned_capsule_form(Form form);

/// Turns round by less than 10 * 2^-53 of the capsule's size, and its middle by 10 more: lines in
/// double are known to 16 of these.
template <class W>
[[gnu::always_inline]] inline Entry<W> enter_turned_capsule(const FormSizes& a, const Line<W>& line,
                                                            const Mask<W>& open) {
  const Vec3<W> z{W(a[2]), W(a[3]), W(a[4])}, x{W(a[5]), W(a[6]), W(a[7])};
  const Vec3<W> y = z.cross(x);
  const auto turned = [&](const Vec3<W>& v) -> Vec3<W> { return {x.dot(v), y.dot(v), z.dot(v)}; };
  Entry<W> entry = enter_capsule<W>(
      a[0], a[1], {turned(line.s), turned(line.d), line.dd, line.inv, W(3) * line.E, line.parallel},
      open);
  const Vec3<W> n = entry.normal;
  entry.normal = x * n.x() + y * n.y() + z * n.z();
  return entry;
}

}  // namespace minkray::exact
