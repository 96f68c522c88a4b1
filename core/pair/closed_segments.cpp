// SPDX-License-Identifier: MIT
#include <algorithm>

#include "core/pair/closed_answer.h"
#include "core/pair/closed_pairs.h"
#include "core/pair/searchable.h"

namespace minkray {
namespace {

/// The parameter, from -1 to 1, of the point of the segment from -half to +half nearest to p.
double nearest_on_segment(const Vec3<double>& half, const Vec3<double>& p) {
  const double squared = half.squaredNorm();
  return squared > 0 ? std::clamp(p.dot(half) / squared, -1.0, 1.0) : 0;
}

/// Too much of a smaller cross product n of p and q is rounding; such segments are parallel to
/// rounding.
bool tells_direction(const Vec3<double>& n, double pp, double qq) {
  constexpr double rounded = 8 * std::numeric_limits<double>::epsilon();
  return n.squaredNorm() > rounded * rounded * pp * qq;
}

/// n's direction, at right angles to p: then to q as well, since what rounding has turned n by is
/// the more, the nearer q is to p.
Vec3<double> common_perpendicular(const Vec3<double>& p, const Vec3<double>& n) {
  const Vec3<double> axis = unit<double>(n);
  return unit<double>(axis - (axis.dot(p) / p.squaredNorm()) * p);
}

/// The nearest points s p and x + t q of two segments, s and t from -1 to 1, of any two: within
/// both, or one of them is an end.
struct OnSegments {
  double s, t;
  bool is_within;  ///< and not parallel: then it is the common perpendicular
};

OnSegments nearest_of_any(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x,
                          const Vec3<double>& n) {
  const double qq = q.squaredNorm();
  if (tells_direction(n, p.squaredNorm(), qq)) {
    // Here s may be rounded by much. t goes with s as it is.
    const double s = x.cross(q).dot(n) / n.squaredNorm(), t = (s * p - x).dot(q) / qq;
    if (std::abs(s) <= 1 && std::abs(t) <= 1) return {s, t, true};
  }
  OnSegments nearest{0, 0, false};
  double best = std::numeric_limits<double>::infinity();
  const auto try_points = [&](double s, double t) {
    const double length = (x + t * q - s * p).squaredNorm();
    if (!(length < best)) return;
    best = length;
    nearest = {s, t, false};
  };
  for (const double end : {-1.0, 1.0}) {
    try_points(nearest_on_segment(p, x + end * q), end);
    try_points(end, nearest_on_segment(q, end * p - x));
  }
  return nearest;
}

/// Answers for segments that are neither nearly parallel nor points (C. Ericson, "Real-Time
/// Collision Detection", 2005, section 5.1.9). `pp`, `qq`, `pq` are products of the two.
OnSegments nearest_of_crossing(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x,
                               double pp, double qq, double pq) {
  const double px = p.dot(x), qx = q.dot(x);
  const double s = std::clamp((px * qq - qx * pq) / (pp * qq - pq * pq), -1.0, 1.0),
               t = (s * pq - qx) / qq;
  if (std::abs(t) <= 1) return {s, t, std::abs(s) < 1};
  const double end = t < 0 ? -1 : 1;
  return {std::clamp((px + end * pq) / pp, -1.0, 1.0), end, false};
}

/// Some direction at right angles to both, whatever they are.
Vec3<double> across(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& n) {
  if (tells_direction(n, p.squaredNorm(), q.squaredNorm())) return common_perpendicular(p, n);
  if (p.squaredNorm() > 0) return p.unitOrthogonal();
  if (q.squaredNorm() > 0) return q.unitOrthogonal();
  return Vec3<double>::UnitX();
}

/// The direction of c = x + t q - s p: no point of A is further along it, and none of B less far.
/// If c is as good as zero, it is one of rounding: that is taken out, twice where that is most of
/// it, since the first time leaves some.
Vec3<double> direction_between(const Vec3<double>& p, const Vec3<double>& q, double pp, double qq,
                               const Vec3<double>& c, double s, double t, const Vec3<double>& n,
                               bool is_crossing) {
  const auto leans_to_a = [&](const Vec3<double>& m) {
    return pp > 0 && (std::abs(s) < 1 || s * m.dot(p) < 0);
  };
  const auto leans_to_b = [&](const Vec3<double>& m) {
    return qq > 0 && (std::abs(t) < 1 || t * m.dot(q) > 0);
  };
  Vec3<double> axis = unit<double>(c);
  for (int i = 0; i < 2; ++i) {
    const bool is_turned_a = leans_to_a(axis);
    if (is_turned_a) axis -= (axis.dot(p) / pp) * p;
    // Nearly parallel ones are at right angles to both only in this order.
    const bool is_turned_b = leans_to_b(axis);
    if (is_turned_b) axis -= (axis.dot(q) / qq) * q;
    const double left = axis.squaredNorm();
    if (!(left > 0.25)) {
      axis = across(p, q, n);
      continue;
    }
    if (is_crossing && is_turned_b && leans_to_a(axis)) {  // at right angles to both
      const Vec3<double> across_both = n / std::sqrt(n.squaredNorm());
      return axis.dot(across_both) < 0 ? Vec3<double>(-across_both) : across_both;
    }
    if (is_turned_a || is_turned_b) axis /= std::sqrt(left);
    constexpr double most_of_it = 1 - 1e-6;
    if (left > most_of_it) break;
  }
  return axis;
}

/// A point, and a segment from x - q to x + q.
CoreDistance point_and_segment(const Vec3<double>& q, const Vec3<double>& x) {
  const double qq = q.squaredNorm(), t = std::clamp(-x.dot(q) / qq, -1.0, 1.0);
  const Vec3<double> c = x + t * q, zero = Vec3<double>::Zero();
  return closed_answer(length_of(c), direction_between(zero, q, 0, qq, c, 0, t, zero, false), zero,
                       c);
}

}  // namespace

CoreDistance between_segments(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x) {
  const double pp = p.squaredNorm(), qq = q.squaredNorm();
  // Products of squares of shorter lengths are no normal numbers, and compared with the smallest
  // length that counts such a length is less than a rounding.
  constexpr double shortest = smallest_length * 0x1p-60;
  const bool is_point_a = !(pp > shortest * shortest), is_point_b = !(qq > shortest * shortest);
  if (is_point_a && is_point_b)
    return closed_between(Vec3<double>::Zero(), x, Vec3<double>::UnitX());
  if (is_point_a) return point_and_segment(q, x);
  if (is_point_b && qq > 0) return between_segments(p, Vec3<double>::Zero(), x);
  const double pq = p.dot(q);
  // Products of nearly parallel ones have too few digits for the nearest points.
  constexpr double parallel = 1e-2;
  const bool is_crossing = pp * qq - pq * pq > parallel * pp * qq && qq > 0;
  const Vec3<double> n = p.cross(q);
  const OnSegments on =
      is_crossing ? nearest_of_crossing(p, q, x, pp, qq, pq) : nearest_of_any(p, q, x, n);
  const Vec3<double> a = on.s * p;
  if (on.is_within) {
    const Vec3<double> axis =
        is_crossing ? Vec3<double>(n / std::sqrt(n.squaredNorm())) : common_perpendicular(p, n);
    const double gap = x.dot(axis);
    const Vec3<double> towards = gap < 0 ? Vec3<double>(-axis) : axis;
    return closed_answer(std::abs(gap), towards, a, std::abs(gap) * towards);
  }
  const Vec3<double> c = x + on.t * q - a;
  Vec3<double> axis = direction_between(p, q, pp, qq, c, on.s, on.t, n, is_crossing);
  const auto gap = [&](const Vec3<double>& m) {
    return m.dot(x) - std::abs(m.dot(p)) - std::abs(m.dot(q));
  };
  const auto try_axis = [&](const Vec3<double>& m) {
    if (!m.isZero(0) && gap(m) > gap(axis)) axis = m;
  };
  // Rounding may hide which ends of nearly parallel ones count: the best plane is taken.
  if (!is_crossing) {
    const Vec3<double> beside = across(p, q, n);
    try_axis(beside.dot(x) < 0 ? Vec3<double>(-beside) : beside);
    const Vec3<double> towards = unit<double>(c);
    try_axis(unit<double>(towards - (towards.dot(p) / pp) * p));
    if (qq > 0) try_axis(unit<double>(towards - (towards.dot(q) / qq) * q));
  }
  CoreDistance found = closed_answer(length_of(c), axis, a, c);
  // The direction is short of digits if they are near each other.
  found.lower = std::min(found.lower, gap(axis));
  return found;
}

}  // namespace minkray
