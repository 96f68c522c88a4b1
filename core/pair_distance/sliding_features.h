// SPDX-License-Identifier: MIT
// Distance of two curved cores to second order. Each point of GJK's simplex lies on a feature of
// the surface and slides along the feature when the direction d turns. S is the weighted sum of the
// features' derivatives. To second order, sliding points have the same closest point as fixed
// points in the metric H = I + S |d| / gap, for which the code of GJK's simplex can be used. With S
// = 0 the method is GJK; with one feature it is Newton's method.
#pragma once

#include <algorithm>

#include "core/pair/core_query.h"
#include "core/pair/simplex_point.h"
#include "core/pair_distance/sliding_metric.h"

namespace minkray {

template <CoreKind A, CoreKind B>
class SlidingFeatures {
 public:
  explicit SlidingFeatures(CoreQuery<A, B>& query) : query_(query) {}

  /// Adds a point of GJK's simplex, given by the features of A and B that it lies on. Points on the
  /// same two features are merged.
  void add(int feature_a, int feature_b, double weight) {
    for (int i = 0; i < count_; ++i)
      if (feature_a_[i] == feature_a && feature_b_[i] == feature_b) {
        weight_[i] += weight;
        return;
      }
    append(feature_a, feature_b, weight);
  }

  /// Searches from the direction d. `damping` (relative to the size) damps the first step; pairs of
  /// a face and a rim need this. Returns true if a result was found.
  bool run(const Vec3<double>& d, double damping);

  /// For overlapping cores: finds a direction near d where the gap has a local maximum, to about
  /// 1e-7. This may be the direction of the depth. Only the gaps found are proven. Returns true if
  /// a direction was found.
  bool settle(const Vec3<double>& d) {
    is_direction_asked_ = true;
    run(d, first_damping);
    return is_settled_;
  }
  const Vec3<double>& direction() const { return direction_; }

  /// Finds the direction of settle() up to rounding, by Newton's method from a direction that is
  /// off by less than `turn`. The maximum may be a peak on one feature, on the crease of two, or at
  /// a corner of more. Returns true if the maximum was found.
  bool sharpen(const Vec3<double>& d, double turn);
  /// Points found by sharpen(): a point of A, and the vector from this point to a point of B.
  const Vec3<double>& sharp_a() const { return sharp_a_; }
  const Vec3<double>& sharp_c() const { return sharp_c_; }

  /// Calls f(point) with points of C around the point that settle() found: for each feature, the
  /// points in three directions at the angle `turn`.
  template <class F>
  void around(double turn, const F& f) const {
    const Vec3<double> e0 = direction_.unitOrthogonal(), e1 = direction_.cross(e0);
    constexpr double cosine[3] = {1, -0.5, -0.5},
                     sine[3] = {0, 0.8660254037844386, -0.8660254037844386};
    for (int i = 0; i < count_; ++i)
      for (int k = 0; k < 3; ++k)
        f(on_features(i, direction_ + (turn * cosine[k]) * e0 + (turn * sine[k]) * e1));
  }

  static constexpr double first_damping = 0.1;

  /// Stores the features of the closest point (those with nonzero weights) in `memory`.
  void remember(PairMemory& memory) const {
    memory.count = count_;
    std::copy(feature_a_, feature_a_ + count_, memory.feature_a);
    std::copy(feature_b_, feature_b_ + count_, memory.feature_b);
  }

 private:
  static constexpr int most_turns = 12, most_turns_settling = 24;
  static constexpr double slight_overlap = 1e-8;  // relative to the size

  void append(int feature_a, int feature_b, double weight) {
    feature_a_[count_] = feature_a;
    feature_b_[count_] = feature_b;
    weight_[count_++] = weight;
  }

  /// Removes the features that have weight 0 in the closest point.
  void keep(const SimplexPoint& closest) {
    int kept = 0;
    for (int i = 0; i < std::min(count_, 4); ++i) {
      if ((closest.kept >> i & 1u) == 0) continue;
      feature_a_[kept] = feature_a_[i];
      feature_b_[kept] = feature_b_[i];
      weight_[kept++] = closest.weight[i];
    }
    count_ = kept;
  }

  /// Finds the point of one or two features, moved by `shift`, that is closest to the origin in the
  /// metric K, and keeps the features that it lies between. Returns its direction in space.
  Vec3<double> nearest_of_two(const Symmetric& K, const Vec3<double>* z,
                              const Vec3<double>& shift) {
    const Vec3<double> first = z[0] + shift;
    weight_[0] = 1;
    if (count_ == 1) return K * first;
    const Vec3<double> edge = z[1] - z[0], turned = K * edge;
    const double length = edge.dot(turned), t = -first.dot(turned);
    if (t > 0 && t < length) {
      weight_[1] = t / length;
      weight_[0] = 1 - weight_[1];
      return K * first + weight_[1] * turned;
    }
    count_ = 1;
    if (!(t > 0)) return K * first;
    feature_a_[0] = feature_a_[1];
    feature_b_[0] = feature_b_[1];
    return K * (z[1] + shift);
  }

  DifferencePoint on_features(int i, const Vec3<double>& d) const {
    const Vec3<double> a = point_of_feature<A>(query_.pair.a, feature_a_[i], d),
                       b = point_of_feature<B>(query_.pair.b, feature_b_[i], query_.pair.to_b(-d));
    return {query_.pair.x + query_.pair.turn * b - a, a, b, feature_a_[i], feature_b_[i]};
  }

  bool is_inside(const Vec3<double>& n, double depth, const Vec3<double>* z, Vec3<double>& common);

  /// One step of Newton's method on the gap of one sliding feature, with curvature S - depth.
  /// Returns false if the gap has no maximum there.
  static bool climb(const Symmetric& S, double depth, const Vec3<double>& n, const Vec3<double>& v,
                    Vec3<double>& next) {
    const Vec3<double> e0 = n.unitOrthogonal(), e1 = n.cross(e0), s0 = S * e0, s1 = S * e1;
    const double b00 = e0.dot(s0) - depth, b01 = e0.dot(s1), b11 = e1.dot(s1) - depth,
                 determinant = b00 * b11 - b01 * b01, trace = b00 + b11;
    constexpr double flattest = 1e-3;
    if (!(trace > 0 && determinant > flattest * trace * trace)) return false;
    const double q0 = e0.dot(v), q1 = e1.dot(v);
    const double m0 = (b11 * q0 - b01 * q1) / determinant, m1 = (b00 * q1 - b01 * q0) / determinant;
    constexpr double furthest = 0.5;  // radians; the curvature is not the same further away
    if (!(m0 * m0 + m1 * m1 < furthest * furthest)) return false;
    next = (n + m0 * e0 + m1 * e1).normalized();
    return true;
  }

  /// Completes a face of C where an edge of A crosses one of B. If only two opposite corners are
  /// known, adds the other two: a corner whose angle is small is hard to hit.
  void complete_face() {
    if (count_ != 2 || feature_a_[0] == feature_a_[1] || feature_b_[0] == feature_b_[1]) return;
    append(feature_a_[0], feature_b_[1], 0);
    append(feature_a_[1], feature_b_[0], 0);
  }

  /// One step of sharpen(): computes the features' weights and the next direction. Returns false if
  /// the gap has no maximum there. `least` is the feature with the least weight.
  bool step_to_peak(const Vec3<double>& n, Vec3<double>& next, int& least);

  CoreQuery<A, B>& query_;
  bool is_direction_asked_ = false, is_settled_ = false;
  Vec3<double> direction_ = Vec3<double>::Zero(), sharp_a_ = Vec3<double>::Zero(),
               sharp_c_ = Vec3<double>::Zero();
  int count_ = 0;
  int feature_a_[4], feature_b_[4];
  double weight_[4];
};

/// True if the middle of C and three points of C around the direction n form a tetrahedron that
/// contains the origin; `common` is their weighted sum. The least n.c over C is -depth.
template <CoreKind A, CoreKind B>
bool SlidingFeatures<A, B>::is_inside(const Vec3<double>& n, double depth, const Vec3<double>* z,
                                      Vec3<double>& common) {
  const Vec3<double> e0 = n.unitOrthogonal(), e1 = n.cross(e0);
  const auto holds = [&](const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& r) {
    const Vec3<double> corners[4] = {p, q, r, query_.pair.x};
    const SimplexPoint closest = closest_of_simplex(corners, 4, false);
    // The weighted sum's distance from the origin is the error due to rounding.
    common = Vec3<double>::Zero();
    for (int i = 0; i < 4; ++i) common += closest.weight[i] * corners[i];
    return closest.is_inside();
  };
  const auto on_feature = [&](int i, const Vec3<double>& d) { return on_features(i, d).c; };
  const double turned = std::sqrt(depth / query_.size) + 1e-9;
  for (const double angle : {0.5 * turned, 5 * turned}) {
    const double c = -0.5 * angle, s = 0.8660254037844386 * angle;
    const Vec3<double> p = query_.nearest(n + angle * e0).c,
                       q = query_.nearest(n + c * e0 + s * e1).c,
                       r = query_.nearest(n + c * e0 - s * e1).c;
    if (holds(p, q, r)) return true;
    if (count_ == 2) {
      const Vec3<double> across = n.cross(z[1] - z[0]);
      const double length = across.norm();
      if (!(length > 0)) continue;
      const Vec3<double> t = across * (angle / length);
      const Vec3<double> f[4] = {on_feature(0, n - t), on_feature(1, n - t), on_feature(0, n + t),
                                 on_feature(1, n + t)};
      if (holds(f[0], f[1], f[2]) || holds(f[0], f[1], f[3]) || holds(f[0], f[2], f[3]) ||
          holds(f[1], f[2], f[3]))
        return true;
    }
    if (count_ >= 3 && holds(z[0], z[1], z[2])) return true;
    if (count_ == 4 &&
        (holds(z[0], z[1], z[3]) || holds(z[0], z[2], z[3]) || holds(z[1], z[2], z[3])))
      return true;
  }
  return false;
}

template <CoreKind A, CoreKind B>
bool SlidingFeatures<A, B>::run(const Vec3<double>& d, double damping) {
  Vec3<double> nd = d;
  const int most = is_direction_asked_ ? most_turns_settling : most_turns;
  for (int step = 0; step < most; ++step, damping = step < 7 ? damping * 0.1 : 0) {
    const DifferencePoint w = query_.nearest(nd);
    const double length = nd.norm(), inverse = 1 / length, gap = inverse * nd.dot(w.c);
    const Vec3<double> n = inverse * nd;
    query_.result.raise_lower(gap, n);
    if (query_.result.lower > query_.search.apart) {
      query_.result.status = CoreStatus::separated;
      return true;
    }
    Vec3<double> z[5], v = Vec3<double>::Zero(), on_a = Vec3<double>::Zero();
    Symmetric S;
    bool is_known = false;
    const Vec3<double> of_b = query_.pair.to_b(-nd);
    for (int i = 0; i < count_; ++i) {
      const bool is_same_a = feature_a_[i] == w.feature_a, is_same_b = feature_b_[i] == w.feature_b;
      const Vec3<double> a = is_same_a ? w.a
                                       : point_of_feature<A>(query_.pair.a, feature_a_[i], nd),
                         b = is_same_b ? w.b
                                       : point_of_feature<B>(query_.pair.b, feature_b_[i], of_b);
      z[i] = query_.pair.x + query_.pair.turn * b - a;
      v += weight_[i] * z[i];
      on_a += weight_[i] * a;
      is_known |= is_same_a && is_same_b;
      add_curvature<A>(S, weight_[i], query_.pair.a, feature_a_[i], nd, a);
      add_curvature<B>(TurnedSum{S, query_.pair.turn}, weight_[i], query_.pair.b, feature_b_[i],
                       of_b, b);
    }
    if (v.norm() - query_.result.lower <= query_.gap)
      return query_.end_at(CoreStatus::separated, on_a, v);
    // If the gap is small or negative, C is moved away until the gap is `least`.
    const double least = query_.size * std::max(1e-4, damping);
    const double shift = gap > least ? 0 : least - gap;
    if (shift > 0 && gap <= 0 && is_known) {
      // The points of a slight overlap are not improved later, unlike its direction.
      const bool is_slight = !is_direction_asked_ && -gap <= slight_overlap * query_.size;
      const double stationary = is_slight && step + 1 < most ? 1e-9 : 1e-7;
      const Vec3<double> aside = v - v.dot(n) * n;
      if (aside.squaredNorm() < stationary * stationary * query_.size * query_.size) {
        direction_ = n;
        is_settled_ = true;
        if (is_direction_asked_) return false;
        Vec3<double> common;
        if (!is_inside(n, -gap, z, common)) return false;
        return query_.end_at(CoreStatus::overlapping, on_a, common);
      }
    }
    if (is_direction_asked_ && gap <= 0 && is_known && count_ == 1) {
      Symmetric of_unit;
      of_unit.add_all(length, S);
      if (climb(of_unit, -gap, n, v, nd)) continue;
    }
    const double scale = length / (gap > least ? gap : least);
    if (!is_known) {
      if (count_ == 4) return false;
      z[count_] = w.c;
      append(w.feature_a, w.feature_b, 0);
    }
    if (count_ <= 2) {
      nd = nearest_of_two(adjugate(S, scale), z, shift * n);
      if (!(nd.squaredNorm() > 0)) return false;
      continue;
    }
    const SlidingMetric metric(S, scale);
    Vec3<double> mapped[4];
    for (int i = 0; i < count_; ++i) mapped[i] = metric.into(z[i] + shift * n);
    const SimplexPoint closest = closest_of_simplex(mapped, count_, false);
    if (closest.kept == 0 || closest.is_inside()) return false;
    nd = metric.out_of(closest.v);
    if (!(nd.squaredNorm() > 0)) return false;
    keep(closest);
  }
  return false;
}

template <CoreKind A, CoreKind B>
bool SlidingFeatures<A, B>::step_to_peak(const Vec3<double>& n, Vec3<double>& next, int& least) {
  const Vec3<double> of_b = query_.pair.to_b(-n);
  Vec3<double> a[4], b[4], c[4];
  for (int i = 0; i < count_; ++i) {
    a[i] = point_of_feature<A>(query_.pair.a, feature_a_[i], n);
    b[i] = point_of_feature<B>(query_.pair.b, feature_b_[i], of_b);
    c[i] = query_.pair.x + query_.pair.turn * b[i] - a[i];
  }
  next = n;
  weight_[0] = 1;
  if (count_ == 2) {
    const auto aside = [&](int i) -> Vec3<double> { return c[i] - n.dot(c[i]) * n; };
    const Vec3<double> across = aside(0) - aside(1);
    const double squared = across.squaredNorm();
    if (!(squared > 0)) return false;
    weight_[0] = -aside(1).dot(across) / squared;
    weight_[1] = 1 - weight_[0];
    next -= (n.dot(c[0] - c[1]) / squared) * across;
  } else if (count_ > 2) {
    const Vec3<double> u = c[1] - c[0], v = c[2] - c[0], plane = u.cross(v);
    const double squared = plane.squaredNorm();
    constexpr double thinnest = 1e-3;  // sine of the least angle between u and v
    if (!(squared > thinnest * thinnest * u.squaredNorm() * v.squaredNorm())) return false;
    next = plane / std::sqrt(squared);
    if (next.dot(n) < 0) next = -next;
    // Weights of the plane's point nearest to the origin, by areas.
    const Vec3<double> to_foot = next.dot(c[0]) * next - c[0];
    weight_[1] = to_foot.cross(v).dot(plane) / squared;
    weight_[2] = u.cross(to_foot).dot(plane) / squared;
    weight_[0] = 1 - weight_[1] - weight_[2];
    for (int i = 3; i < count_; ++i) weight_[i] = 0;
  }
  Symmetric S;
  sharp_a_.setZero();
  sharp_c_.setZero();
  least = 0;
  for (int i = 0; i < count_; ++i) {
    if (weight_[i] < weight_[least]) least = i;
    sharp_a_ += weight_[i] * a[i];
    sharp_c_ += weight_[i] * c[i];
    add_curvature<A>(S, weight_[i], query_.pair.a, feature_a_[i], n, a[i]);
    add_curvature<B>(TurnedSum{S, query_.pair.turn}, weight_[i], query_.pair.b, feature_b_[i], of_b,
                     b[i]);
  }
  const double depth = -n.dot(sharp_c_);
  if (count_ == 1) return climb(S, depth, n, sharp_c_, next);
  if (count_ == 2) {
    const Vec3<double> along = n.cross(c[0] - c[1]).normalized();
    const double bend = along.dot(S * along), peak = bend - depth;
    constexpr double flattest = 1e-3;
    if (!(peak > flattest * (bend + depth))) return false;
    next += (along.dot(sharp_c_) / peak) * along;
  }
  next.normalize();
  return true;
}

template <CoreKind A, CoreKind B>
bool SlidingFeatures<A, B>::sharpen(const Vec3<double>& d, double turn) {
  count_ = 0;
  const auto take = [&](const Vec3<double>& along) {
    const DifferencePoint w = query_.nearest(along);
    for (int i = 0; i < count_; ++i)
      if (feature_a_[i] == w.feature_a && feature_b_[i] == w.feature_b) return true;
    if (count_ == 4) return false;
    append(w.feature_a, w.feature_b, 0);
    return true;
  };
  const Vec3<double> e0 = d.unitOrthogonal(), e1 = d.cross(e0);
  if (!take(d)) return false;
  constexpr double half_root = 0.8660254037844386;
  constexpr double around[6][2] = {{1, 0},  {0.5, half_root},   {-0.5, half_root},
                                   {-1, 0}, {-0.5, -half_root}, {0.5, -half_root}};
  for (const auto& way : around)
    if (!take(d + turn * (way[0] * e0 + way[1] * e1))) return false;
  complete_face();
  constexpr int most_steps = 12;
  constexpr double still = 1e-12;    // radians
  constexpr double outside = -1e-9;  // of a weight
  direction_ = d;
  for (int step = 0; step < most_steps; ++step) {
    Vec3<double> next;
    int least = 0;
    if (!step_to_peak(direction_, next, least)) return false;
    // If a face has more than three corners, any three of them can have the nonzero weights.
    if (count_ > 1 && count_ < 4 && weight_[least] < outside) {
      --count_;
      feature_a_[least] = feature_a_[count_];
      feature_b_[least] = feature_b_[count_];
      complete_face();
      direction_ = d;
      continue;
    }
    const bool is_still = (next - direction_).norm() <= still;
    direction_ = next;
    if (is_still) return true;
  }
  return false;
}

}  // namespace minkray
