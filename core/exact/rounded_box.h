// SPDX-License-Identifier: MIT
// Closed form of rounded boxes. The slabs of the inner box divide space into shares: the regions of
// faces, edges and corners. Starts where the line enters the box grown by the radius, and follows
// the line from share to share. In each share the surface is a plane, a cylinder or a ball; the
// first share in which the line enters this surface gives the result.
#pragma once

#include "core/exact/ball.h"

namespace minkray::exact {

/// Sizes: three half extents of the box before rounding, radius.
struct RoundedBoxForm : FormDefaults {
  static constexpr FormKind kind{5};
  static constexpr bool is_inlined = true;
  static constexpr Lanes lanes = Lanes::sizes;

  static DeclaredForm rounded(DeclaredForm form, double radius) {
    form.sizes[3] += radius;
    return form;
  }

  static Form prepared(Form form) {
    const FormSizes& a = form.sizes;
    if (!(a[3] > 0)) return {};
    form.R = Vec3<double>(a[0], a[1], a[2]).norm() + a[3];
    return form;
  }

  static double least_radius(const Form& form) { return form.sizes[3]; }

  template <class W, class Numbers>
  [[gnu::always_inline]] static Entry<W> enter(const Numbers& form, const Line<W>& line,
                                               const Mask<W>& open) {
    const auto& sizes = form.sizes;
    using std::abs;
    using std::copysign;
    using std::max;
    using std::min;
    using std::sqrt;
    // A line crosses at most three pairs of planes, so it passes through at most seven shares.
    constexpr int most_shares = 7;
    const W r(sizes[3]);
    // The line is mirrored so that it runs towards +x, +y, +z.
    Vec3<W> sign, d, s, inv, first, last, e;
    for (int i = 0; i < 3; ++i) {
      const W grown = W(sizes[static_cast<std::size_t>(i)]) + r;
      sign[i] = copysign(W(1), line.d[i]);
      d[i] = abs(line.d[i]);
      s[i] = sign[i] * line.s[i];
      inv[i] = W(1) / max(d[i], W(least_component<W>));
      first[i] = (-grown - s[i]) * inv[i];
      last[i] = (grown - s[i]) * inv[i];
      e[i] = line.E * inv[i];
    }
    const auto largest = [](const Vec3<W>& v) { return max(max(v.x(), v.y()), v.z()); };
    const auto least = [](const Vec3<W>& v) { return min(min(v.x(), v.y()), v.z()); };
    const W lo = largest(first - e), hi = largest(first + e);
    const W out_lo = least(last - e), out_hi = least(last + e);
    const auto axis = [&](const Mask<W>& by_x, const Mask<W>& by_y) -> Vec3<W> {
      const W x = select(by_x, W(1), W(0)), y = select(by_y & !by_x, W(1), W(0));
      return {x * sign.x(), y * sign.y(), (W(1) - x - y) * sign.z()};
    };
    Entry<W> entry;
    entry.miss = open & (lo > out_hi);
    if (any(entry.miss)) {
      const Vec3<W> entered = -axis(first.x() - e.x() == lo, first.y() - e.y() == lo);
      const Vec3<W> left = axis(last.x() + e.x() == out_hi, last.y() + e.y() == out_hi);
      entry.normal = between(entered, left, line.d);
    }
    Mask<W> going = open & (hi <= out_lo);
    if (!any(going)) return entry;

    // In a face's share, the line is within both other slabs.
    const W t = largest(first);
    const Mask<W> by_x = first.x() == t, by_y = (first.y() == t) & !by_x, by_z = !(by_x | by_y);
    const auto beyond = [&](int i, const Mask<W>& is_face) {
      const W h(sizes[static_cast<std::size_t>(i)]);
      return select(is_face, W(-h), W(abs(s[i] + t * d[i]) - h));
    };
    const W outside = max(max(beyond(0, by_x), beyond(1, by_y)), beyond(2, by_z));
    const Mask<W> by_face = going & (outside <= W(0));
    entry.t = t;
    entry.e = select(by_x, e.x(), select(by_y, e.y(), e.z()));
    entry.normal = select<W>(by_face, Vec3<W>(-axis(by_x, by_y)), entry.normal);
    // At a distance w from the end of a share, the surface of the next share is about w^2 / 2r
    // away. Undecided only if w^2 > E r (core/exact/capsule.h).
    const W area = r * line.E;
    const W w2 = entry.e * entry.e * line.dd;
    entry.hit = by_face & !((w2 > area) & (outside * outside < w2));
    going &= !by_face;
    if (!any(going)) return entry;

    Vec3<W> begins, ends;  // parameters at which the line enters and leaves the inner slabs
    for (int i = 0; i < 3; ++i) {
      const W h(sizes[static_cast<std::size_t>(i)]);
      begins[i] = (-h - s[i]) * inv[i];
      ends[i] = (h - s[i]) * inv[i];
    }
    W from = t;
    for (int share = 0; share < most_shares && any(going); ++share) {
      // The share that begins at `from`. `along` selects the axes along which the line is outside
      // the slab.
      W until(std::numeric_limits<Lane<W>>::infinity());
      Vec3<W> p, along;
      for (int i = 0; i < 3; ++i) {
        const W h(sizes[static_cast<std::size_t>(i)]);
        const Mask<W> before = from < begins[i], after = from >= ends[i];
        until = min(until, select(before, begins[i], select(after, until, ends[i])));
        along[i] = select(before | after, d[i], W(0));
        p[i] = select(before, W(s[i] + h), select(after, W(s[i] - h), W(0)));
      }
      const W across = along.squaredNorm();
      const W inverse = W(1) / max(across, line.parallel);
      const W k = select(across < line.parallel, W(0), W(-p.dot(along) * inverse));
      const Vec3<W> x = p + along * k;
      const W h2 = r * r - x.squaredNorm(), margin = W(tolerance::form_tangent) * r * line.E;
      const W half = sqrt(max(h2, W(0)) * inverse), at = k - half;
      const Mask<W> on = going & (at > until), here = going & !on;
      const Mask<W> hit = here & (h2 > margin), miss = here & (h2 < -margin);
      const W error = W(2) * r * line.E * inverse / half, width = error * error * line.dd;
      const Mask<W> unsure = (width > area) & ((until - at < error) | (at - from < error));
      entry.hit |= hit & !unsure;
      entry.miss |= miss;
      entry.t = select(hit, at, entry.t);
      entry.e = select(hit, error, entry.e);
      const Vec3<W> outward = select<W>(hit, Vec3<W>((x - along * half) * (W(1) / r)), x);
      entry.normal = select<W>(hit | miss, Vec3<W>(outward.cwiseProduct(sign)), entry.normal);
      if (share == 0 && any(miss)) {
        // True if the line moves away from the inner box where it enters the grown box.
        const Mask<W> recedes = miss & (k < from);
        const Vec3<W> there = (p + along * from).cwiseProduct(sign);
        const Vec3<W> separating = between(Vec3<W>(-axis(by_x, by_y)), there, line.d);
        entry.normal = select<W>(recedes, separating, entry.normal);
      }
      from = select(on, until, from);
      going = on;
    }
    return entry;
  }
};

}  // namespace minkray::exact
