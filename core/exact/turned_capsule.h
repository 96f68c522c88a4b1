// SPDX-License-Identifier: MIT
// Closed form of capsules along any axis: rotates the line to a capsule along z.
#pragma once

#include "core/exact/capsule.h"
#include "core/exact/form.h"

namespace minkray::exact {

/// Sizes: half the vector from end to end, radius. After preparation: radius, half height, and the
/// capsule's z and x axes.
struct TurnedCapsuleForm : FormDefaults {
  static constexpr FormKind kind{10};
  static constexpr bool is_round = true;

  /// The form of segments is for rounded segments.
  static DeclaredForm of(const Segment& shape) {
    const Vec3<double>&a = shape.points[0], &b = shape.points[1];
    const Vec3<double> half = (b - a) / 2;
    return {{half.x(), half.y(), half.z(), 0}, a + half};
  }

  static DeclaredForm rounded(DeclaredForm form, double radius) {
    form.sizes[3] += radius;
    return form;
  }

  static Form prepared(Form form) {
    const double radius = form.sizes[3];
    if (!(radius > 0)) return {};
    using Long = Vec3<long double>;
    const Vec3<double> half(form.sizes[0], form.sizes[1], form.sizes[2]);
    const Long along = half.cast<long double>();
    const double length = static_cast<double>(along.norm());
    if (!(length > 0)) {
      form.kind = BallForm::kind;
      form.sizes = {radius};
      return BallForm::prepared(form);
    }
    form.R = length + radius;
    const Vec3<double> z = along.normalized().cast<double>();
    const Vec3<double> x = along.unitOrthogonal().cast<double>();
    form.sizes = {radius, length, z.x(), z.y(), z.z(), x.x(), x.y(), x.z()};
    return form;
  }

  /// Triples the line's error bound E, for the rounding of the rotation: less than 10 * 2^-53 of
  /// the capsule's size, and as much again for its middle. E of a line in double is at least
  /// 16 * 2^-53 of the size.
  template <class W, class Numbers>
  [[gnu::always_inline]] static Entry<W> enter(const Numbers& form, const Line<W>& line,
                                               const Mask<W>& open) {
    const auto& a = form.sizes;
    const Vec3<W> z{W(a[2]), W(a[3]), W(a[4])}, x{W(a[5]), W(a[6]), W(a[7])};
    const Vec3<W> y = z.cross(x);
    const auto turned = [&](const Vec3<W>& v) -> Vec3<W> { return {x.dot(v), y.dot(v), z.dot(v)}; };
    Entry<W> entry = CapsuleForm::enter<W>(
        form, {turned(line.s), turned(line.d), line.dd, line.inv, W(3) * line.E, line.parallel},
        open);
    const Vec3<W> n = entry.normal;
    entry.normal = x * n.x() + y * n.y() + z * n.z();
    return entry;
  }
};

}  // namespace minkray::exact
