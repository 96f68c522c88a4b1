// SPDX-License-Identifier: MIT
#include <algorithm>

#include "core/pair/closed_answer.h"
#include "core/pair/closed_pairs.h"
#include "core/pair/searchable.h"

namespace minkray {
namespace {

/// Returns the s in [-1, 1] for which s * half is nearest to p: the nearest point of the segment
/// from -half to +half.
double nearest_on_segment(const Vec3<double>& half, const Vec3<double>& p) {
  const double squared = half.squaredNorm();
  return squared > 0 ? std::clamp(p.dot(half) / squared, -1.0, 1.0) : 0;
}

/// True if the cross product n of p and q is large enough to have a direction. If n is smaller,
/// most of it is rounding error, and the segments count as parallel.
bool tells_direction(const Vec3<double>& n, double pp, double qq) {
  constexpr double rounded = 8 * std::numeric_limits<double>::epsilon();
  return n.squaredNorm() > rounded * rounded * pp * qq;
}

/// Returns the direction of n, corrected to be perpendicular to p. If p and q are nearly parallel,
/// it is then perpendicular to q, too; otherwise n needs no correction.
Vec3<double> common_perpendicular(const Vec3<double>& p, const Vec3<double>& n) {
  const Vec3<double> axis = unit<double>(n);
  return unit<double>(axis - (axis.dot(p) / p.squaredNorm()) * p);
}

/// Nearest points of two segments: s p on A and x + t q on B, with s and t in [-1, 1]. Either both
/// points are inside their segments, or at least one is an end.
struct OnSegments {
  double s, t;
  bool is_within;  ///< both are inside; the line between them is the common perpendicular
};

/// Returns the nearest points of any two segments, by trying the inside and all four ends.
OnSegments nearest_of_any(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x,
                          const Vec3<double>& n) {
  const double qq = q.squaredNorm();
  if (tells_direction(n, p.squaredNorm(), qq)) {
    // The error of s may be large here, so t is computed from the rounded s.
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

/// Returns the nearest points of segments that are neither nearly parallel nor points (C. Ericson,
/// "Real-Time Collision Detection", 2005, section 5.1.9). `pp`, `qq` and `pq` are dot products.
OnSegments nearest_of_crossing(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x,
                               double pp, double qq, double pq) {
  const double px = p.dot(x), qx = q.dot(x);
  const double s = std::clamp((px * qq - qx * pq) / (pp * qq - pq * pq), -1.0, 1.0),
               t = (s * pq - qx) / qq;
  if (std::abs(t) <= 1) return {s, t, std::abs(s) < 1};
  const double end = t < 0 ? -1 : 1;
  return {std::clamp((px + end * pq) / pp, -1.0, 1.0), end, false};
}

/// Returns a direction perpendicular to p and q, which may be parallel or zero.
Vec3<double> across(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& n) {
  if (tells_direction(n, p.squaredNorm(), q.squaredNorm())) return common_perpendicular(p, n);
  if (p.squaredNorm() > 0) return p.unitOrthogonal();
  if (q.squaredNorm() > 0) return q.unitOrthogonal();
  return Vec3<double>::UnitX();
}

/// Returns the direction of c = x + t q - s p, corrected so that s p is A's furthest point along it
/// and x + t q is B's nearest. If c is nearly zero, most of it is rounding error: the correction
/// removes this error, and a second correction removes the remainder.
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
    // For nearly parallel segments, only this order gives a direction perpendicular to both.
    const bool is_turned_b = leans_to_b(axis);
    if (is_turned_b) axis -= (axis.dot(q) / qq) * q;
    const double left = axis.squaredNorm();
    if (!(left > 0.25)) {
      axis = across(p, q, n);
      continue;
    }
    if (is_crossing && is_turned_b && leans_to_a(axis)) {  // perpendicular to both
      const Vec3<double> across_both = n / std::sqrt(n.squaredNorm());
      return axis.dot(across_both) < 0 ? Vec3<double>(-across_both) : across_both;
    }
    if (is_turned_a || is_turned_b) axis /= std::sqrt(left);
    constexpr double most_of_it = 1 - 1e-6;
    if (left > most_of_it) break;
  }
  return axis;
}

/// Returns the distance between a point at the origin and the segment from x - q to x + q.
CoreDistance point_and_segment(const Vec3<double>& q, const Vec3<double>& x) {
  const double qq = q.squaredNorm(), t = std::clamp(-x.dot(q) / qq, -1.0, 1.0);
  const Vec3<double> c = x + t * q, zero = Vec3<double>::Zero();
  return closed_answer(length_of(c), direction_between(zero, q, 0, qq, c, 0, t, zero, false), zero,
                       c);
}

}  // namespace

CoreDistance between_segments(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x) {
  const double pp = p.squaredNorm(), qq = q.squaredNorm();
  // Segments shorter than this count as points. Products of their squares would not be normal
  // numbers, and their length is less than the rounding of the smallest length that matters.
  constexpr double shortest = smallest_length * 0x1p-60;
  const bool is_point_a = !(pp > shortest * shortest), is_point_b = !(qq > shortest * shortest);
  if (is_point_a && is_point_b)
    return closed_between(Vec3<double>::Zero(), x, Vec3<double>::UnitX());
  if (is_point_a) return point_and_segment(q, x);
  if (is_point_b && qq > 0) return between_segments(p, Vec3<double>::Zero(), x);
  const double pq = p.dot(q);
  // For nearly parallel segments, the products have too few digits to give the nearest points.
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
  // Rounding may hide which ends of nearly parallel segments are nearest. So this tries several
  // planes and takes the best.
  if (!is_crossing) {
    const Vec3<double> beside = across(p, q, n);
    try_axis(beside.dot(x) < 0 ? Vec3<double>(-beside) : beside);
    const Vec3<double> towards = unit<double>(c);
    try_axis(unit<double>(towards - (towards.dot(p) / pp) * p));
    if (qq > 0) try_axis(unit<double>(towards - (towards.dot(q) / qq) * q));
  }
  CoreDistance found = closed_answer(length_of(c), axis, a, c);
  // If the segments are near each other, the direction has too few digits to give the exact gap.
  found.lower = std::min(found.lower, gap(axis));
  return found;
}

}  // namespace minkray
