// SPDX-License-Identifier: MIT
// Finds where a line enters a capsule along any axis: rotates the line to a capsule along z.
#pragma once

#include "core/exact/capsule.h"
#include "core/exact/form.h"

namespace minkray::exact {

/// Converts declared sizes (half the vector from end to end, radius) to radius, half height, and
/// the capsule's z and x axes.
Form turned_capsule_form(Form form);

/// Finds where lines enter the capsule. Triples the line's error bound E, for the rounding of the
/// rotation: less than 10 * 2^-53 of the capsule's size, and as much again for its middle. E of a
/// line in double is at least 16 * 2^-53 of the size.
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
