// SPDX-License-Identifier: MIT
// Closed form of cylinders around the z axis that are cut by two planes at any angles. Line and
// Entry are in core/query/line.h; results are valid only in `open` lanes.
#pragma once

#include "core/exact/form.h"
#include "core/exact/mantle.h"
#include "core/exact/nappe.h"

namespace minkray::exact {

/// The half-space below the plane normal.x = offset.
template <class W>
struct Cut {
  Vec3<W> normal;
  W in, out, e;  ///< parameters at which the line enters and leaves; their error

  Cut(const double* outward, double offset, const Line<W>& line)
      : normal(W(outward[0]), W(outward[1]), W(outward[2])) {
    using std::abs;
    using std::max;
    const W slope = normal.dot(line.d), room = W(offset) - normal.dot(line.s);
    const W inv = W(1) / max(abs(slope), W(least_component<W>)), t = room * inv;
    const Mask<W> enters = slope < W(0);
    in = select(enters, W(-t), W(-endless<W>));
    out = select(enters, W(endless<W>), t);
    e = line.E * inv;
  }
};

/// Sizes: radius; heights of both planes on the z axis (lower, upper); slopes along x and y of the
/// lower plane, then of the upper plane. After preparation: radius; offsets of the lower and the
/// upper plane; their outward unit normals.
struct CutCylinderForm : FormDefaults {
  static constexpr FormKind kind{8};
  static constexpr std::size_t lengths = 3;

  static DeclaredForm of(const CutCylinder& shape) {
    const double below = shape.heights[0], above = shape.heights[1];
    const double middle = below / 2 + above / 2;
    return {{shape.radius, below - middle, above - middle, shape.lower_slope[0],
             shape.lower_slope[1], shape.upper_slope[0], shape.upper_slope[1]},
            {0, 0, middle}};
  }

  /// Returns no form if the planes cross within the cylinder by more than rounding.
  static Form prepared(Form form) {
    const double r = form.sizes[0], below = form.sizes[1], above = form.sizes[2];
    const double *low = &form.sizes[3], *high = &form.sizes[5];
    if (!(above - below >=
          r * std::hypot(high[0] - low[0], high[1] - low[1]) * (1 - tolerance::form_touching)))
      return {};
    const double steepest = std::max(std::hypot(low[0], low[1]), std::hypot(high[0], high[1]));
    form.R = std::hypot(r, std::max(std::abs(below), std::abs(above)) + r * steepest);
    const Vec3<double> l = Vec3<double>(low[0], low[1], -1).normalized();
    const Vec3<double> u = Vec3<double>(-high[0], -high[1], 1).normalized();
    form.sizes = {r, l.z() * below, u.z() * above, l.x(), l.y(), l.z(), u.x(), u.y(), u.z()};
    return form;
  }

  template <class W, class Numbers>
  [[gnu::always_inline]] static Entry<W> enter(const Numbers& form, const Line<W>& line,
                                               const Mask<W>& open) {
    const auto& sizes = form.sizes;
    using std::max;
    using std::min;
    const double r = sizes[0];
    Entry<W> entry;
    // Excludes lines far from the ball, for which the rounding of planes would exceed E.
    const W reach = W(form.R) + W(2) * line.E;
    const Mask<W> misses_ball = open & (line.s.squaredNorm() > reach * reach);
    const Mantle<W> round(r, line, open & !misses_ball);
    entry.miss = round.miss | misses_ball;
    entry.normal = select<W>(misses_ball, line.s, Vec3<W>(round.x, round.y, W(0)));
    if (!any(round.hit)) return entry;
    const Cut<W> low(&sizes[3], sizes[1], line), high(&sizes[6], sizes[2], line);
    const W t = max(round.in, max(low.in, high.in));
    const W lo = max(W(round.in - round.in_e), max(W(low.in - low.e), W(high.in - high.e)));
    const W hi = max(W(round.in + round.in_e), max(W(low.in + low.e), W(high.in + high.e)));
    const W out_lo = min(W(round.out - round.out_e), min(W(low.out - low.e), W(high.out - high.e)));
    const W out_hi = min(W(round.out + round.out_e), min(W(low.out + low.e), W(high.out + high.e)));
    entry.hit = round.hit & (hi <= out_lo);
    entry.t = t;
    entry.e = max(hi - t, t - lo);
    const Vec3<W> side = round.normal_in(line);
    const auto either = [&](const Mask<W>& by_low, const Mask<W>& by_high, const Vec3<W>& by_side) {
      return select<W>(by_low, low.normal, select<W>(by_high, high.normal, by_side));
    };
    entry.normal = select<W>(round.hit, either(low.in == t, high.in == t, side), entry.normal);
    const Mask<W> passes = round.hit & (lo > out_hi);
    if (any(passes)) {
      // The surfaces that prove the miss, chosen by the bounds.
      const Vec3<W> entered = either(low.in - low.e == lo, high.in - high.e == lo, side);
      const Vec3<W> left =
          either(low.out + low.e == out_hi, high.out + high.e == out_hi, round.normal_out(line));
      entry.normal = select<W>(passes, between(entered, left, line.d), entry.normal);
      entry.miss |= passes;
    }
    return entry;
  }
};

}  // namespace minkray::exact
