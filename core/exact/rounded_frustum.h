// SPDX-License-Identifier: MIT
// Finds where a line enters a cylinder or frustum grown by a ball. Starts where the line enters the
// grown lids and side, before the edges are rounded. Between a lid and the side, the surface is a
// torus around the edge: iterates from there, then proves a bracket of the entry, or a separating
// plane. Line and Entry are in core/query/line.h.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/exact/lids.h"
#include "core/exact/mantle.h"
#include "core/exact/nappe.h"

namespace minkray::exact {

/// A line and the points within a radius of a circle, the edge between a lid and the side.
template <class W>
class RoundedEdge {
 public:
  /// `up`: 1 or -1, the end of the z axis.
  RoundedEdge(const Form& form, const Line<W>& line, const W& up)
      : line_(line),
        up_(up),
        circle_(select(up > W(0), W(form.sizes[1]), W(form.sizes[0]))),
        height_(form.sizes[2]),
        radius_(form.sizes[3]),
        cosine_(form.sizes[5]),
        sine_(up * W(form.sine)) {}

  /// A point of the line, seen from the circle's nearest point. The square of its distance from
  /// there is about square + 2 half_slope t + curvature t^2.
  struct At {
    W x, y, out, up;  ///< outward from the circle and upward from the lid
    W q, square;      ///< distance from the axis; squared distance less radius^2
    W half_slope, curvature;
  };

  At at(const W& t) const {
    using std::max;
    using std::sqrt;
    const Vec3<W>& d = line_.d;
    At p;
    p.x = line_.s.x() + t * d.x();
    p.y = line_.s.y() + t * d.y();
    p.q = sqrt(p.x * p.x + p.y * p.y);
    p.out = p.q - circle_;
    p.up = up_ * (line_.s.z() + t * d.z()) - height_;
    p.square = p.out * p.out + p.up * p.up - radius_ * radius_;
    const W inverse = W(1) / max(p.q, max(circle_, W(least_component<W>)));
    const W share = circle_ * inverse, along = p.x * d.x() + p.y * d.y();
    const W radial = along * inverse;
    p.half_slope = (W(1) - share) * along + p.up * (up_ * d.z());
    p.curvature =
        (W(1) - share) * (d.x() * d.x() + d.y() * d.y()) + share * radial * radial + d.z() * d.z();
    return p;
  }

  /// True if the nearest point of the shape before rounding is on the circle.
  Mask<W> is_nearest(const At& p) const {
    return (p.out >= W(0)) & (p.out * sine_ <= p.up * cosine_);
  }

  /// Lower bound of the squared distance from the shape before rounding, less radius^2.
  W least_square(const At& p) const {
    using std::max;
    const W from_planes = max(max(p.up, W(p.out * cosine_ + p.up * sine_)), W(0));
    return select(is_nearest(p), p.square, W(from_planes * from_planes - radius_ * radius_));
  }

  /// Outward normal at a point that is about `radius` from the circle.
  Vec3<W> normal(const At& p) const {
    using std::max;
    const W per_q = p.out / max(p.q, W(least_component<W>));
    return {p.x * per_q, p.y * per_q, up_ * p.up};
  }

 private:
  const Line<W>& line_;
  W up_, circle_, height_, radius_, cosine_, sine_;
};

/// Finds where lines enter a rounded edge near the parameter `from`. Completes `entry` in the lanes
/// `open`, if the bracket or the plane is proven.
template <class W>
[[gnu::always_inline]] inline void enter_rounded_edge(Entry<W>& entry, const RoundedEdge<W>& edge,
                                                      const Form& form, const W& from,
                                                      const Line<W>& line, const Mask<W>& open) {
  using std::abs;
  using std::max;
  using std::sqrt;
  // Cubic convergence: the step after a step this short is below rounding.
  constexpr int most_steps = 12;
  const double radius = form.sizes[3], R = form.R;
  const W short_step(0x1p-36 * radius * radius);
  const W margin = W(4 * radius) * line.E;
  // A plane across the normal, turned by an angle a to be parallel to the line, moves by at most
  // 4 a R at the form. Rounding of half_slope is below 3 E |d|, which moves the plane by 12 E R / 2
  // radius; rounding of its normal adds less.
  const W reach = W(R) * sqrt(line.inv), turned = W(8) * reach;
  const W plane_margin = margin + W(24 * R) * line.E;
  W t = max(from, -reach);
  typename RoundedEdge<W>::At p = edge.at(t);
  Mask<W> going = open, arrived(false);
  for (int step = 0; step < most_steps; ++step) {
    const W D = p.half_slope * p.half_slope - p.curvature * p.square;
    const Mask<W> meets = D > W(0), falls = p.half_slope < W(0);
    const Mask<W> passes = going & !meets & (abs(t) <= reach) & edge.is_nearest(p) &
                           (p.square > plane_margin + turned * abs(p.half_slope));
    if (any(passes)) {
      entry.miss |= passes;
      entry.normal = select<W>(passes, edge.normal(p), entry.normal);
      going &= !passes;
      if (!any(going)) break;
    }
    const W root = sqrt(max(D, W(0)));
    const W way = select(falls & meets, W(p.square / (root - p.half_slope)),
                         W(-(p.half_slope + root) / p.curvature));
    t = select(going, W(t + way), t);
    const Mask<W> settled = going & meets & (way * way * line.dd < short_step);
    arrived |= settled;
    going &= !settled;
    if (!any(going)) break;
    p = edge.at(t);
  }
  if (!any(arrived)) return;
  // The entry is between a point that is outside and one that is inside, whatever rounds.
  p = edge.at(t);
  const W e = margin / max(-p.half_slope, W(least_component<W>));
  const Mask<W> bracketed = arrived & (p.half_slope < W(0)) &
                            (edge.least_square(edge.at(t - e)) > margin) &
                            (edge.at(t + e).square < -margin);
  entry.hit |= bracketed;
  entry.t = select(bracketed, t, entry.t);
  entry.e = select(bracketed, e, entry.e);
  entry.normal = select<W>(bracketed, Vec3<W>(edge.normal(p) * W(1 / radius)), entry.normal);
}

/// Sizes: the disks' radii at -z and +z and half the height before rounding, rounding radius. After
/// preparation, the lower disk is the larger one; the fifth and sixth size are the height of the
/// grown cone's apex and the cosine of its half angle.
struct RoundedFrustumForm : FormDefaults {
  static constexpr FormKind kind{9};

  /// The form of disks is for rounded disks.
  static DeclaredForm of(const Disk& shape) { return {{shape.radius, shape.radius, 0, 0}}; }

  static DeclaredForm rounded(DeclaredForm form, double radius) {
    form.kind = kind;
    form.sizes[3] += radius;
    return form;
  }

  /// Returns no form if the apex is too far away, the side too flat, or the edge of the grown side
  /// and lid too far outside the ball of radius R.
  static Form prepared(Form form) {
    larger_end_below(form);
    const double lower = form.sizes[0], upper = form.sizes[1], half_height = form.sizes[2],
                 rounding = form.sizes[3];
    if (!(rounding > 0)) return {};
    form.R = std::hypot(lower, half_height) + rounding;
    form.sizes[5] = 1;
    if (lower == upper) return form;
    form.slope = (lower - upper) / (2 * half_height);
    const double cosine = 1 / std::sqrt(1 + form.slope * form.slope);
    form.sine = form.slope * cosine;
    if (!(form.sine < tolerance::tapered_steepest)) return {};
    const double apex = half_height + upper / form.slope + rounding / form.sine;
    const double widest = lower + rounding * (1 + form.sine) / cosine;
    form.sizes[4] = apex;
    form.sizes[5] = cosine;
    const bool is_bounded = apex < tolerance::tapered_farthest_apex * form.R &&
                            std::hypot(widest, half_height + rounding) < 2 * form.R;
    return is_bounded ? form : Form();
  }

  static double least_radius(const Form& form) { return form.sizes[3]; }

  template <class W>
  static Entry<W> enter(const Form& form, const Line<W>& line, const Mask<W>& open) {
    // Rounding hides edges that are hardly rounded.
    const Mask<W> is_clear = open & (line.E < W(form.sizes[3] / 16));
    return form.slope > 0
               ? enter(form, Nappe<W>(form, form.sizes[4], line, is_clear), line)
               : enter(form, Mantle<W>(form.sizes[0] + form.sizes[3], line, is_clear), line);
  }

 private:
  template <template <class> class Side, class W>
  static Entry<W> enter(const Form& form, const Side<W>& side, const Line<W>& line) {
    using std::abs;
    using std::copysign;
    using std::min;
    const double half_height = form.sizes[2], radius = form.sizes[3];
    Entry<W> entry = enter_between_lids(side, half_height + radius, line);
    const Mask<W> enters = entry.hit;
    if (!any(enters)) return entry;
    const W t = entry.t, facing = copysign(W(1), line.d.z());
    const Vec3<W> x = line.s + line.d * t;
    const W low(-half_height + radius * form.sine), high(half_height + radius * form.sine);
    const W circle = select(facing < W(0), W(form.sizes[1]), W(form.sizes[0]));
    const W q2 = x.x() * x.x() + x.y() * x.y() - circle * circle;
    const Mask<W> by_side = side.in == t;
    const Mask<W> on_side = by_side & (x.z() >= low) & (x.z() <= high);
    const Mask<W> on_lid = (!by_side) & (q2 <= W(0));
    entry.e = W(2) * entry.e;
    // Undecided for the same reason as for a capsule (core/exact/capsule.h).
    const W w2 = entry.e * entry.e * line.dd;
    // A lower bound of the distance from the joint of two parts.
    const W to_joint =
        select(by_side, W(min(abs(x.z() - low), abs(x.z() - high))), W(q2 * W(0.5 / form.R)));
    const Mask<W> unsure = (w2 > W(radius) * line.E) & (to_joint * to_joint < w2);
    entry.hit &= (on_side | on_lid) & !unsure;

    const Mask<W> by_edge = enters & !(on_side | on_lid);
    if (any(by_edge)) {
      const W up = select(by_side, select(x.z() > high, W(1), W(-1)), -facing);
      enter_rounded_edge(entry, RoundedEdge<W>(form, line, up), form, t, line, by_edge);
    }
    return entry;
  }
};

}  // namespace minkray::exact
