// SPDX-License-Identifier: MIT
// The model of a shape with a gauge (core/support/declared.h) is the shape itself. Along the ray,
// the gauge is convex, and 1 on the surface. The gradient there is the normal, and one support call
// in this direction proves the hit. If the least gauge is above 1, two tangents of the gauge that
// cross above 1 give a separating plane (docs/forms.md, section 9).
#pragma once

#include "core/model/line_cast.h"

namespace minkray {

template <class W, class S>
class GaugeModel {
 public:
  using T = Lane<W>;

  struct Feature {
    Vec3<W> s;  ///< the support point, relative to the ray's s
    W support_function(const Vec3<W>& n) const { return s.dot(n); }
    const Vec3<W>& support_point(const Vec3<W>&) const { return s; }
  };

  GaugeModel(const S& shape, const Vec3<T>& centre, const Vec3<W>& s, const Vec3<W>& r, T R)
      : shape_(shape),
        from_(widen<W>(centre) + s),
        s_(s),
        r_(r),
        to_unit_(widen<W>(Vec3<T>(shape.radii.cwiseInverse()))),
        u_(from_.cwiseProduct(to_unit_)),
        v_(r.cwiseProduct(to_unit_)),
        R_(R) {}

  const Vec3<W>& to_frame(const Vec3<W>& n) const { return n; }
  const Vec3<W>& to_shape(const Vec3<W>& n) const { return n; }
  W against_ray(const Vec3<W>& n) const { return -n.dot(r_); }

  Feature support(const Vec3<W>& n, const Mask<W>&) const {
    return {Vec3<W>(shape_.template support<W>(n) - from_)};
  }

  ModelHit<W> begin(const Vec3<T>&) {
    const Found found = find();
    hits_ = found.hits;
    const Vec3<W> n = unit<W>(found.gradient.cwiseProduct(to_unit_));
    ModelHit<W> hit;
    hit.m = n;
    if (!all(hits_)) hit.m = select<W>(hits_, n, across(n));
    hit.height = -found.lambda;
    hit.certain = hits_;
    return hit;
  }

  /// Called only if the plane does not confirm the hit that `begin` found. If planes are so nearly
  /// parallel to the ray that rounding is large along the ray, the plane may still meet the ray at
  /// a point of the shape, up to rounding. Otherwise the ray is tangent up to rounding, and the
  /// next plane is along the ray.
  ModelHit<W> step(const Feature& feature, const Vec3<W>& n, int) {
    const W z = against_ray(n);
    const Mask<W> ahead = z > W(0);
    ModelHit<W> hit;
    hit.height = feature.support_function(n) / select(ahead, z, W(1));
    const auto gauge = shape_.template gauge_along<W>(u_, v_, W(-hit.height));
    hit.certain = hits_ & ahead & (gauge.value <= W(1) + rounding_of(gauge.gradient));
    hit.m = select<W>(hits_ & !hit.certain, across(n), n);
    hit.repeated = hit.certain | !hits_;
    hits_ &= hit.certain;
    return hit;
  }

 private:
  struct Found {
    Mask<W> hits;  ///< a hit at `lambda`
    W lambda;
    Vec3<W> gradient;  ///< gradient of the gauge at the hit; for a miss, at the least gauge
  };

  /// A point of the line, and the tangent of the gauge at this point.
  struct Tangent {
    W lambda, value, slope;
    Vec3<W> gradient = Vec3<W>::Zero();
    Mask<W> there = Mask<W>(false);

    void set(const Mask<W>& lanes, const W& at, const typename S::template Gauge<W>& gauge) {
      lambda = select(lanes, at, lambda);
      value = select(lanes, gauge.value, value);
      slope = select(lanes, gauge.slope, slope);
      gradient = select<W>(lanes, gauge.gradient, gradient);
      there |= lanes;
    }
  };

  struct Crossing {
    W value;
    Vec3<W> gradient;
  };

  /// Crossing of two tangents, one on either side of the least gauge. The crossing bounds the gauge
  /// from below. A weighted mean of the tangents is constant along the ray; its gradient is the
  /// normal of a plane along the ray.
  static Crossing crossing(const Tangent& left, const Tangent& right, const Mask<W>& both) {
    const W fall = -left.slope, sum = select(both, W(fall + right.slope), W(1));
    const W difference = fall * right.slope * (right.lambda - left.lambda);
    return {(right.value * fall + left.value * right.slope - difference) / sum,
            Vec3<W>((left.gradient * right.slope + right.gradient * fall) / sum)};
  }

  /// Returns the component perpendicular to the ray, scaled to unit length. If the component is
  /// zero, returns the direction against the ray.
  Vec3<W> across(const Vec3<W>& n) const {
    const Vec3<W> crosswise = unit<W>(Vec3<W>(n - r_ * n.dot(r_)));
    return select<W>(crosswise.squaredNorm() > W(0), crosswise, Vec3<W>(-r_));
  }

  /// The line is u_ + lambda v_, in units of the radii. The gauge is convex, so the zero of a
  /// tangent of (gauge - 1) is a lower bound of the first hit. The square of the gauge is nearly a
  /// parabola (exactly, for p = 2), and the parabola's zero is the next guess. If this zero is
  /// outside the known interval, the next guess is the middle of the interval.
  Found find() const {
    using std::abs;
    using std::max;
    using std::min;
    using std::sqrt;
    const W separated = W(T(2) * tolerance::jet_gap<T> * R_);

    // Starts where the line meets a ball between the inscribed and the circumscribed ball.
    const W v_squared = v_.squaredNorm(), v_length = sqrt(v_squared), along = u_.dot(v_);
    const Vec3<W> nearest = u_ - v_ * (along / v_squared);
    const W radius_squared = W(shape_.template squared_start<T>());
    const W depth = max(W(radius_squared - nearest.squaredNorm()), W(0));
    W lambda = -(along + sqrt(depth * v_squared)) / v_squared;

    W lower = W(T(-2) * R_), upper = W(T(2) * R_);
    Tangent left, right;
    left.lambda = lower;
    left.value = left.slope = right.lambda = right.value = right.slope = W(0);
    Found found{Mask<W>(false), lambda, Vec3<W>::Zero()};
    // Excludes lanes that miss the bounding ball or have no direction.
    Mask<W> open = (s_.squaredNorm() <= W(T(1.01) * R_ * R_)) & (v_squared > W(0));
    for (int i = 0; i < max_evaluations; ++i) {
      const auto gauge = shape_.template gauge_along<W>(u_, v_, lambda);
      const W rounding = rounding_of(gauge.gradient);
      const W over = (gauge.value - W(1)) * (gauge.value + W(1));
      const W b = gauge.value * gauge.slope, c = gauge.curvature;
      const W den = b * b - c * over;
      const Mask<W> falls = gauge.slope < W(0);
      const Mask<W> meets = den > W(0);
      const W root = sqrt(max(den, W(0)));
      // These formulas have no cancellation on either side of the least gauge.
      const W to_zero = select(falls, W(over / (root - b)), W(-(root + b) / c));
      const W next = lambda + select(meets, to_zero, W(-b / c));
      const W tangent_zero = lambda - (gauge.value - W(1)) / select(falls, gauge.slope, W(-1));
      const W step = abs(next - lambda) * v_length;
      const Mask<W> close = abs(gauge.value - W(1)) <= W(2) * rounding;
      const Mask<W> settled = falls & meets &
                              (abs(next - tangent_zero) * -gauge.slope <= rounding) &
                              (close | trusted(step));
      found.gradient = select<W>(open, gauge.gradient, found.gradient);
      found.lambda = select(open, next, found.lambda);
      found.hits |= open & settled;
      open &= !settled;
      if (!any(open)) break;

      // Two tangents that cross bound the gauge from below.
      const Mask<W> outside = gauge.value > W(1);
      left.set(open & falls & outside, lambda, gauge);
      right.set(open & (!falls) & outside, lambda, gauge);
      const Mask<W> both = open & left.there & right.there;
      if (any(both)) {
        const auto [least, gradient] = crossing(left, right, both);
        const W above = least - W(1);
        const W length_squared = gradient.cwiseProduct(to_unit_).squaredNorm();
        const Mask<W> separates =
            (above > W(0)) & (above * above > separated * separated * length_squared);
        const Mask<W> known = min(left.value, right.value) - least <= rounding;
        const Mask<W> ends = both & (separates | known);
        found.gradient = select<W>(ends, gradient, found.gradient);
        open &= !ends;
      }
      const Mask<W> level = (abs(gauge.slope) <= rounding * v_length) & outside;
      open &= !level;
      if (!any(open)) break;

      lower = select(falls, max(lower, tangent_zero), lower);
      upper = select(falls & outside, upper, min(upper, lambda));
      // A bound beyond the least gauge proves a miss, but does not locate the least gauge.
      const Mask<W> in_order = lower < upper;
      const W from = select(in_order, lower, left.lambda);
      const Mask<W> fits = (next > from) & (next < upper), creeps = in_order & (next <= from);
      const W other = select(creeps, from, W((from + upper) * W(T(0.5))));
      lambda = select(open, select(fits, next, other), lambda);
    }
    return found;
  }

  /// Change of a gauge with this gradient, caused by a few roundings of a position.
  W rounding_of(const Vec3<W>& gradient) const {
    return gradient.cwiseProduct(to_unit_).norm() * W(T(2) * tolerance::epsilon<T> * R_);
  }

  /// True if the parabola is as accurate as the gauge over a step of this length.
  Mask<W> trusted(const W& step) const {
    return shape_.parabola_error(step) <= W(tolerance::epsilon<T>);
  }

  /// Most rays need two or three evaluations; those that graze a flat spot or a sharp edge, up to
  /// twenty.
  static constexpr int max_evaluations = 32;

  const S& shape_;
  Vec3<W> from_, s_, r_;  ///< s in the shape's frame; s and r in the ball's frame
  Vec3<W> to_unit_;       ///< 1 / radii
  Vec3<W> u_, v_;         ///< s and r in units of the radii
  T R_;
  Mask<W> hits_ = Mask<W>(false);
};

}  // namespace minkray
