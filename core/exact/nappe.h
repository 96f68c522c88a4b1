// SPDX-License-Identifier: MIT
// Finds where a line enters and leaves an infinite cone around the z axis, below the apex (the
// lower nappe of a double cone). Used by forms with two round ends of different sizes.
#pragma once

#include "core/exact/form.h"
#include "core/query/line.h"
#include "core/query/tolerances.h"

namespace minkray::exact {

/// Mirrors a form whose first two sizes are the radii at -z and +z, so that its apex is above.
inline void larger_end_below(Form& form) {
  if (!(form.sizes[1] > form.sizes[0])) return;
  std::swap(form.sizes[0], form.sizes[1]);
  form.is_upside_down = true;
}

/// Computes the height of the apex, from the half height and the upper radius, for a cone whose
/// radius is less by `narrows` per height. Returns no form if the apex is too far away for the
/// bounds that docs/forms.md derives.
inline Form with_apex(Form form, double narrows) {
  form.sizes[3] = form.sizes[2] + form.sizes[1] / narrows;
  return form.sizes[3] < tolerance::tapered_farthest_apex * form.R ? form : Form();
}

/// A parameter greater than all parameters at which lines meet shapes. Products with a line's
/// coordinates do not overflow.
template <class W>
inline constexpr Lane<W> endless = 1 / least_to_square<Lane<W>>;

/// The points with x^2 + y^2 <= slope^2 (apex - z)^2 and z <= apex. `apex` is the height of the
/// cone's tip. R is the radius of a ball around the form, which lies within 2 max(R, apex) of the
/// tip.
template <class W>
struct Nappe {
  Mask<W> hit, miss;       ///< of both nappes, above and below the apex; neither: undecided
  W in, in_e, out, out_e;  ///< parameters of entry and exit, and their errors; -endless or
                           ///< endless if there is no entry or exit

  /// The form has members slope, sine and R.
  template <class Numbers, class S>
  Nappe(const Numbers& form, const S& apex, const Line<W>& line, const Mask<W>& open)
      : slope_(form.slope), sine_(form.sine), apex_(apex) {
    using std::abs;
    using std::copysign;
    using std::max;
    using std::min;
    using std::sqrt;
    const W square = slope_ * slope_, R(form.R), size = max(R, apex_);
    const Vec3<W>& d = line.d;
    const Vec3<W> p(line.s.x(), line.s.y(), line.s.z() - apex_);
    // The quadratic's discriminant, from the line's moment: b^2 - ac would cancel.
    moment_ = p.cross(d);
    const W D = square * (moment_.x() * moment_.x() + moment_.y() * moment_.y()) -
                moment_.z() * moment_.z();
    const W length = sqrt(line.dd);
    const W margin = W(4) * max(W(1), square) * line.E * length *
                     (line.E * length + abs(moment_.x()) + abs(moment_.y()) + abs(moment_.z()));
    hit = open & (D > margin);
    miss = open & (D < -margin);
    a_ = d.x() * d.x() + d.y() * d.y() - square * d.z() * d.z();
    // A line that is less steep than the cone enters and leaves the same nappe.
    const Mask<W> is_flat = a_ > W(0);
    const W a = select(is_flat, a_, min(a_, W(-least_component<W>)));
    const W b = p.x() * d.x() + p.y() * d.y() - square * p.z() * d.z();
    const W c = p.x() * p.x() + p.y() * p.y() - square * p.z() * p.z();
    const W root = sqrt(max(D, margin)), q = -(b + copysign(root, b));
    const W t1 = q / a, t2 = c / q;
    const W per_R = length * (W(1) / R), base = W(2) * size * (W(1) + square) * line.E / root;
    const W w1 = W(1) + abs(t1) * per_R, w2 = W(1) + abs(t2) * per_R;
    const W e1 = base * w1 * w1, e2 = base * w2 * w2;
    // A steep line crosses the surface once in each nappe. A line that goes down enters the lower
    // nappe at the greater of the two parameters; a line that goes up leaves the lower nappe at the
    // lesser one.
    const Mask<W> first = t1 < t2, down = d.z() < W(0), enters = is_flat | down,
                  leaves = is_flat | !down;
    const Mask<W> in_first = (is_flat & first) | ((!is_flat) & !first);
    in = select(enters, select(in_first, t1, t2), W(-endless<W>));
    in_e = select(enters, select(in_first, e1, e2), W(0));
    out = select(leaves, select(in_first, t2, t1), W(endless<W>));
    out_e = select(leaves, select(in_first, e2, e1), W(0));
  }

  /// Outward unit normals where the line enters and leaves.
  [[gnu::always_inline]] Vec3<W> normal_in(const Line<W>& line) const { return normal(in, line); }
  [[gnu::always_inline]] Vec3<W> normal_out(const Line<W>& line) const { return normal(out, line); }

  /// True for lines that enter and leave the nappe above the apex, which is not part of the form.
  Mask<W> is_above(const Line<W>& line) const {
    return hit & (a_ > W(0)) & (line.s.z() + out * line.d.z() > apex_);
  }

  /// For a line that misses both nappes or crosses only the upper one: the normal of the plane that
  /// touches the cone and is parallel to the line.
  [[gnu::always_inline]] Vec3<W> separating(const Line<W>& line) const {
    using std::copysign;
    using std::max;
    using std::sqrt;
    const Vec3<W>& d = line.d;
    const W across = d.x() * d.x() + d.y() * d.y();
    const W along = (-slope_) * d.z(), turn = -copysign(sqrt(max(a_, W(0))), moment_.z());
    return {along * d.x() - turn * d.y(), along * d.y() + turn * d.x(), slope_ * across};
  }

 private:
  [[gnu::always_inline]] Vec3<W> normal(const W& t, const Line<W>& line) const {
    using std::max;
    using std::sqrt;
    const W x = line.s.x() + t * line.d.x(), y = line.s.y() + t * line.d.y();
    const W per = (sine_ / slope_) / sqrt(max(W(x * x + y * y), W(least_component<W>)));
    return {x * per, y * per, sine_};
  }

  W slope_, sine_, apex_;
  Vec3<W> moment_;
  W a_;
};

}  // namespace minkray::exact
