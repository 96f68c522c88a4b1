// SPDX-License-Identifier: MIT
// State of a search for a time of impact: cores A at rest and B, which moves without turning, and
// the bounds proven so far. C is the set of all b - a with a in A and b in B (core_pair.h); here it
// is grown by both radii.
#pragma once

#include <algorithm>

#include "core/pair/core_pair.h"

namespace minkray {

enum class SweptStatus : unsigned char {
  open,  ///< neither hit nor miss is proven; the bounds hold
  hit,
  miss,
};

/// Result of the search, in A's frame.
struct SweptTime {
  SweptStatus status = SweptStatus::open;
  double t_lo = -std::numeric_limits<double>::infinity();  ///< no contact before t_lo
  /// A time at which the cores touch or overlap; infinite if none was found.
  double t_hi = std::numeric_limits<double>::infinity();
  Vec3<double> axis = Vec3<double>::Zero();  ///< normal of the plane that proves t_lo or the miss
  Vec3<double> a = Vec3<double>::Zero();     ///< a point of A that is also a point of B at t_hi
  /// Estimated error of the axis of a hit, in radians. Infinite if it was not requested, or is
  /// larger than derivatives allow: it is then about the square root of the bounds' gap.
  double axis_error = std::numeric_limits<double>::infinity();
  int supports = 0;
};

/// A point y = b - a of C: its projection along the motion, p e0 + q e1 with the axes e0 and e1 of
/// SweptQuery, its height h along the motion, and the features of A and B that it is from.
struct SweptPoint {
  Vec3<double> y, a;
  double p, q, h;
  int feature_a, feature_b;
  Vec3<double> d = {};  ///< of a support point: its direction, of any length
};

inline double cross(const SweptPoint& a, const SweptPoint& b) {
  return a.p * b.q - a.q * b.p;
}

/// True if the two bounds of a time, `width` apart, are near enough to end a search: B moves at
/// most `near` between them. If `near` is 0, they must be as near as rounding allows. approach()
/// returns the speed along the normal of the plane that proves the lower bound.
template <class Approach>
bool have_met(double width, double speed, double near, double rounding, const Approach& approach) {
  constexpr double roundings = 3;
  if (near > 0) [[likely]]
    return width * speed <= near;
  return width * approach() <= roundings * rounding;
}

template <CoreKind A, CoreKind B>
struct SweptQuery {
  const CorePair& pair;
  Vec3<double> velocity;  ///< of B, in A's frame
  /// Latest time of interest; largest distance that B moves between the two bounds of a hit (see
  /// have_met).
  double t_max, near;
  bool is_for_derivatives;  ///< also computes an axis that derivatives can use
  double radius = pair.a.radius + pair.b.radius;
  double size = pair.size() + radius;
  double speed = velocity.norm();
  Vec3<double> along = velocity / speed;
  Vec3<double> e0 = along.unitOrthogonal(), e1 = along.cross(e0);
  double rounding = pair.rounding();
  SweptTime result = {};

  SweptQuery(const CorePair& of, const Vec3<double>& v, double most, double nearness,
             bool for_derivatives)
      : pair(of), velocity(v), t_max(most), near(nearness), is_for_derivatives(for_derivatives) {}

  /// Makes a point from y = b - a and a.
  SweptPoint in_shadow(const Vec3<double>& y, const Vec3<double>& a, int of_a, int of_b) const {
    return {y, a, e0.dot(y), e1.dot(y), along.dot(y), of_a, of_b, {}};
  }
  /// Returns the point of the cores' difference with the least y.d.
  DifferencePoint nearest(const Vec3<double>& d) {
    ++result.supports;
    return nearest_along<A, B>(pair, d);
  }
  /// Returns the point of C with the least y.d.
  SweptPoint support(const Vec3<double>& d) {
    const DifferencePoint w = nearest(d);
    SweptPoint point = grown(w.c, w.a, d, w.feature_a, w.feature_b);
    point.d = d;
    return point;
  }
  /// Moves a point of the cores' difference to the surface of C, by both radii against d.
  SweptPoint grown(const Vec3<double>& c, const Vec3<double>& a, const Vec3<double>& d, int of_a,
                   int of_b) const {
    if (!(radius > 0)) return in_shadow(c, a, of_a, of_b);
    return grown_along(d / d.norm(), c, a, of_a, of_b);
  }
  /// Same for a unit vector n.
  SweptPoint grown_along(const Vec3<double>& n, const Vec3<double>& c, const Vec3<double>& a,
                         int of_a, int of_b) const {
    return in_shadow(c - radius * n, a + pair.a.radius * n, of_a, of_b);
  }
  /// Returns the furthest point of the given features along d, which need not be the support point
  /// of C.
  SweptPoint on_features(int of_a, int of_b, const Vec3<double>& d) const {
    const Vec3<double> a = point_of_feature<A>(pair.a, of_a, d),
                       b = point_of_feature<B>(pair.b, of_b, pair.to_b(-d));
    return grown(pair.x + pair.turn * b - a, a, d, of_a, of_b);
  }

  void end(SweptStatus status, const Vec3<double>& axis) {
    result.status = status;
    result.axis = unit<double>(axis);
  }
  /// Error of an axis, in radians, below which derivatives need no better one.
  static constexpr double small_axis_error = 1e-8;

  /// Takes a better axis of a hit.
  void take_axis(const Vec3<double>& n, double error) {
    result.axis = unit<double>(n);
    result.axis_error = error;
  }

  /// Ends the search with a hit. Returns true, so that callers can return it.
  bool end_hit() {
    result.status = SweptStatus::hit;
    return true;
  }

  /// True if the bounding balls miss each other by more than rounding, which proves a miss.
  bool passes_by() {
    const double towards = pair.x.dot(along);
    const Vec3<double> aside = pair.x - towards * along;
    const double distance = towards >= 0 ? pair.x.norm() : aside.norm();
    if (!(distance > size + near + rounding)) return false;
    end(SweptStatus::miss, towards >= 0 ? pair.x : aside);
    return true;
  }

  /// Applies the bound that the plane with normal n through w proves. Returns true if the plane
  /// proves a miss.
  bool judge(const Vec3<double>& n, const SweptPoint& w) { return judge(n, n.norm(), n.dot(w.y)); }
  /// Same for a normal of the given length and the least n.y of C.
  bool judge(const Vec3<double>& n, double length, double least) {
    const double gap = least - rounding * length, approach = -n.dot(velocity);
    if (!(approach > 0)) {
      if (!(gap > near * length)) return false;
      end(SweptStatus::miss, n);
      return true;
    }
    if (gap - t_max * approach > near * length) {
      end(SweptStatus::miss, n);
      return true;
    }
    const double t = gap / approach;
    if (t > result.t_lo) {
      result.t_lo = t;
      result.axis = n / length;
    }
    return false;
  }

  /// Takes a time at which `at`, a point of A, is also a point of B as an upper bound.
  void lower_t_hi(double t, const Vec3<double>& at) {
    if (!(t < result.t_hi)) return;
    result.t_hi = t;
    result.a = at;
  }

  /// Tests whether the origin is inside the triangle at the time at which the origin is in the
  /// triangle's plane. If so, takes this time as an upper bound and returns true.
  bool pierce(const SweptPoint& r, const SweptPoint& s, const SweptPoint& t) {
    const double at_r = cross(s, t), at_s = cross(t, r), at_t = cross(r, s),
                 area = at_r + at_s + at_t, sign = area < 0 ? -1 : 1;
    // Triangles thinner than this are ignored: rounding moves their sides too far.
    constexpr double sliver = 1e-10;
    const double reach = std::max({std::abs(r.p) + std::abs(r.q), std::abs(s.p) + std::abs(s.q),
                                   std::abs(t.p) + std::abs(t.q)});
    if (!(sign * at_r >= 0 && sign * at_s >= 0 && sign * at_t >= 0 &&
          std::abs(area) > sliver * size * reach))
      return false;
    const double p1 = s.p - r.p, q1 = s.q - r.q, h1 = s.h - r.h, p2 = t.p - r.p, q2 = t.q - r.q,
                 h2 = t.h - r.h, across = p1 * q2 - q1 * p2;
    // The weights of a thin triangle give a point slightly off the origin. A second step corrects
    // them; the height is then corrected along the triangle's plane, by a distance so small that
    // the rounding of the plane's slope does not matter. Rounding also moves the points sideways,
    // which changes the height in proportion to the plane's steepness.
    double of_s = at_s / area, of_t = at_t / area;
    double p = r.p + of_s * p1 + of_t * p2, q = r.q + of_s * q1 + of_t * q2;
    of_s -= (p * q2 - q * p2) / across;
    of_t -= (p1 * q - q1 * p) / across;
    p = r.p + of_s * p1 + of_t * p2;
    q = r.q + of_s * q1 + of_t * q2;
    const double rise_p = (h1 * q2 - q1 * h2) / across, rise_q = (p1 * h2 - h1 * p2) / across,
                 of_r = 1 - of_s - of_t;
    const double h = r.h + of_s * h1 + of_t * h2 - rise_p * p - rise_q * q,
                 allowed = rounding * (1 + std::abs(rise_p) + std::abs(rise_q));
    lower_t_hi((allowed - h) / speed, of_r * r.a + of_s * s.a + of_t * t.a);
    return true;
  }

  double approach_of_axis() const { return -result.axis.dot(velocity); }

  /// True if the bounds of the time are near enough to end the search.
  bool has_met() const {
    return have_met(result.t_hi - result.t_lo, speed, near, rounding,
                    [&] { return approach_of_axis(); });
  }
};

}  // namespace minkray
