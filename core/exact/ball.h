// SPDX-License-Identifier: MIT
// Closed form of balls and, in a scaled frame, ellipsoids: where a line enters a ball around the
// origin. Line and Entry are in core/query/line.h; results are valid only in `open` lanes.
#pragma once

#include "core/exact/form.h"
#include "core/query/line.h"
#include "core/query/tolerances.h"

namespace minkray::exact {

/// Sizes: the radius. For ellipsoids before preparation: 0, three radii.
struct BallForm : FormDefaults {
  static constexpr FormKind kind{1};
  static constexpr bool is_inlined = true, is_round = true;
  static constexpr Lanes lanes = Lanes::sizes;

  /// The form of points is for rounded points.
  static DeclaredForm of(const Point& shape) { return {{0}, shape.position}; }
  static DeclaredForm of(const Sphere& shape) { return {{shape.radius}}; }
  static DeclaredForm of(const Ellipsoid& shape) {
    return {{0, shape.radii[0], shape.radii[1], shape.radii[2]}};
  }

  static DeclaredForm rounded(DeclaredForm form, double radius) {
    if (!radii_of(form.sizes).isZero(0)) return {};
    form.sizes[0] += radius;
    return form;
  }

  static Form prepared(Form form) {
    const Vec3<double> radii = radii_of(form.sizes);
    if (!radii.isZero(0)) {
      form.scale = radii.cwiseInverse();
      form.is_scaled = true;
      form.largest_scale = form.scale.maxCoeff();
      form.inner_R = radii.maxCoeff();
      form.sizes = {1};
    }
    form.R = form.sizes[0];
    return form;
  }

  static double least_radius(const Form& form) { return form.sizes[0]; }

  template <class W, class Numbers>
  [[gnu::always_inline]] static Entry<W> enter(const Numbers& form, const Line<W>& line,
                                               const Mask<W>& open) {
    using std::max;
    using std::sqrt;
    const W r(form.sizes[0]);
    Entry<W> entry;
    const W h2 = r * r - line.s.squaredNorm(), margin = W(tolerance::form_tangent) * r * line.E;
    entry.hit = open & (h2 > margin);
    entry.miss = open & (h2 < -margin);
    entry.normal = line.s;
    if (!any(entry.hit)) return entry;
    const W half = sqrt(max(h2, margin) * line.inv);
    entry.t = -half;
    entry.e = line.E * r * line.inv / half;
    entry.normal =
        select<W>(entry.hit, Vec3<W>((line.s - line.d * half) * (W(1) / r)), entry.normal);
    return entry;
  }

 private:
  static Vec3<double> radii_of(const FormSizes& sizes) { return {sizes[1], sizes[2], sizes[3]}; }
};

/// Finds where the line enters the ball at one end of a shape, in the lanes `by_end`, and updates
/// `entry` there. `p` is the line's point s relative to the ball's centre. Returns the lanes whose
/// line misses the ball.
template <class W>
[[gnu::always_inline]] inline Mask<W> enter_end(Entry<W>& entry, const Mask<W>& by_end, const W& r,
                                                const Vec3<W>& p, const Line<W>& line) {
  using std::max;
  using std::sqrt;
  const Vec3<W>& d = line.d;
  const W k = -p.dot(d) * line.inv;
  // Vectors are written number by number: GCC does not inline Eigen's expressions here.
  const Vec3<W> x(p.x() + d.x() * k, p.y() + d.y() * k, p.z() + d.z() * k);
  const W h2 = r * r - x.squaredNorm(), margin = W(tolerance::form_tangent) * r * line.E;
  const Mask<W> hit = by_end & (h2 > margin), miss = by_end & (h2 < -margin);
  const W half = sqrt(max(h2, margin) * line.inv);
  entry.hit |= hit;
  entry.miss |= miss;
  entry.t = select(hit, W(k - half), entry.t);
  entry.e = select(hit, W(W(2) * r * line.E * line.inv / half), entry.e);
  const W per_r = W(1) / r;
  const Vec3<W> there((x.x() - d.x() * half) * per_r, (x.y() - d.y() * half) * per_r,
                      (x.z() - d.z() * half) * per_r);
  const Vec3<W> outward = select<W>(hit, there, x);
  entry.normal = select<W>(hit | miss, outward, entry.normal);
  return miss;
}

}  // namespace minkray::exact
