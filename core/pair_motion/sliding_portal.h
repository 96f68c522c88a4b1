// SPDX-License-Identifier: MIT
// Finds the time of impact of curved cores with quadratic convergence, by sequential quadratic
// programming. Let u be the direction of motion. A supporting plane of C (swept_query.h) with the
// normal n, scaled so that n.u = -1, gives a lower bound of the time. The bound is the minimum of
// one function of n per feature (sliding_features.h). This bound is concave in n; its maximum is
// the time of impact.
#pragma once

#include "core/pair_motion/across_motion.h"
#include "core/pair_motion/swept_query.h"

namespace minkray {

/// For the normal n + m, feature i gives the bound t_i + q_i.m - m S m / 2, where q_i is the
/// feature's projection and S the curvature of all features. The dual problem gives the m that
/// maximises the minimum of these bounds. The dual is a quadratic program with at most four
/// weights, solved by trying all subsets.
template <CoreKind A, CoreKind B>
class SlidingPortal {
 public:
  explicit SlidingPortal(SweptQuery<A, B>& query) : query_(query) {}

  /// Adds a point of the portal, given by the features of A and B that it lies on. Points on the
  /// same two features are merged.
  void add(int feature_a, int feature_b, double weight) {
    for (int i = 0; i < count_; ++i)
      if (feature_a_[i] == feature_a && feature_b_[i] == feature_b) {
        weight_[i] += weight;
        return;
      }
    append(feature_a, feature_b, weight);
  }

  /// Searches from the normal `first`, which faces against the motion; without a portal, from its
  /// support point. `damping` (relative to the size) damps the first steps: the further `first` is
  /// from the best normal, the more rims and corners need. Returns true if the search decided the
  /// query.
  bool run(const Vec3<double>& first, double damping) {
    const CorePair& pair = query_.pair;
    Vec3<double> nd = first / -first.dot(query_.along), best = nd;
    double highest = -std::numeric_limits<double>::infinity();
    double if_diverging = least_damping_after_divergence;
    for (int step = 0; step < most_turns; ++step) {
      const DifferencePoint found = query_.nearest(nd);
      const double length = nd.norm(), inverse = 1 / length;
      const Vec3<double> growth = (query_.radius * inverse) * nd, y = found.c - growth;
      const double height = nd.dot(y);
      if (query_.judge(nd, length, height)) return true;
      const bool has_met = query_.has_met();
      if (has_met && !query_.is_for_derivatives) return query_.end_hit();
      if (!has_met && height < highest - query_.size) {  // starts again with shorter steps
        if (if_diverging > most_damping) return false;
        nd = best;
        count_ = 0;
        damping = if_diverging;
        if_diverging *= 10;
        highest = -std::numeric_limits<double>::infinity();
        continue;
      }
      if (height > highest) {
        highest = height;
        best = nd;
      }
      const Vec3<double> of_b = pair.to_b(-nd);
      if (!has_met && !is_end_tried_ && is_along_an_end(nd, of_b, flat)) {
        is_end_tried_ = true;
        if (meets_end(nd, of_b)) return true;
      }
      if (is_along_an_end(nd, of_b, flattest)) return has_met && query_.end_hit();
      if (count_ == 0) append(found.feature_a, found.feature_b, 1);
      AcrossMotion S;
      double p = 0, q = 0;
      bool is_known = false;
      for (int i = 0; i < count_; ++i) {
        const int on_a = feature_a_[i], on_b = feature_b_[i];
        const bool is_same_a = on_a == found.feature_a, is_same_b = on_b == found.feature_b;
        const Vec3<double> a = is_same_a ? found.a : point_of_feature<A>(pair.a, on_a, nd),
                           b = is_same_b ? found.b : point_of_feature<B>(pair.b, on_b, of_b);
        const bool is_same = is_same_a && is_same_b;
        set_bound(i, nd, is_same ? y : Vec3<double>(pair.x + pair.turn * b - a - growth), a);
        p += weight_[i] * p_[i];
        q += weight_[i] * q_[i];
        is_known |= is_same;
        add_curvature<A>(AcrossSum{S, query_.e0, query_.e1}, weight_[i], pair.a, on_a, nd, a);
        add_curvature<B>(AcrossSum{S, e0_in_b_, e1_in_b_}, weight_[i], pair.b, on_b, of_b, b);
      }
      // The curvature of a ball.
      const double of_radius = query_.radius * inverse;
      S.xx += of_radius;
      S.yy += of_radius;
      S.add(-of_radius, query_.e0.dot(nd) * inverse, query_.e1.dot(nd) * inverse);
      if (has_met) return end_hit(S, is_known, nd);
      if (are_level() && p * p + q * q <= stationary * stationary * query_.size * query_.size) {
        if (settle(nd, is_known)) return end_hit(S, is_known, nd);
        if (is_known && count_ < 3 && query_.near > 0) return false;
      }
      if (!is_known) {
        if (count_ == 4) return false;
        append(found.feature_a, found.feature_b, 0);
        set_bound(count_ - 1, nd, y, found.a);
      }
      if (!advance(S, damping, nd)) return false;
      damping = step < turns_damped ? 0.1 * damping : 0;
    }
    return false;
  }

 private:
  static constexpr int most_turns = 12, turns_damped = 7;
  /// Damping when the search starts again.
  static constexpr double least_damping_after_divergence = 0.3, most_damping = 10;
  /// Distance of the weighted point from the line of motion at the best normal, relative to the
  /// size. The bound's error is of the order of its square.
  static constexpr double stationary = 3e-8;
  /// Angles between the best normal and those of the points that prove an upper bound. The points
  /// lie below the plane by the square of the angle. The smaller angle is the root of the rounding.
  static constexpr double turn_if_near = 3e-6, least_turn = 1e-8;

  void append(int feature_a, int feature_b, double weight) {
    feature_a_[count_] = feature_a;
    feature_b_[count_] = feature_b;
    weight_[count_++] = weight;
  }

  /// Sets the bound that feature i gives for the normal nd, by its point y and the point a of A's
  /// core.
  void set_bound(int i, const Vec3<double>& nd, const Vec3<double>& y, const Vec3<double>& a) {
    y_[i] = y;
    a_[i] = a;
    t_[i] = nd.dot(y);
    p_[i] = query_.e0.dot(y);
    q_[i] = query_.e1.dot(y);
  }

  /// True if all features give the same bound, so that none of them lowers it.
  bool are_level() const {
    constexpr double of_near = 0.1;
    const double most = query_.near > 0 ? of_near * query_.near : query_.rounding;
    for (int i = 1; i < count_; ++i)
      if (std::abs(t_[i] - t_[0]) > most) return false;
    return true;
  }

  /// Sines of the angle between a normal and that of a flat end: below the first, the support point
  /// jumps and only the portal can continue; below the second, the first contact may be on the end.
  static constexpr double flattest = 1e-6, flat = 0.3;

  static bool is_along(const ShapeCore& core, const Vec3<double>& d, double sine) {
    return core.kind == CoreKind::disks &&
           d.x() * d.x() + d.y() * d.y() < sine * sine * d.squaredNorm();
  }
  bool is_along_an_end(const Vec3<double>& nd, const Vec3<double>& of_b, double sine) const {
    return is_along(query_.pair.a, nd, sine) || is_along(query_.pair.b, of_b, sine);
  }

  /// Tests whether the first contact is on a flat end whose normal is near nd. Returns true if this
  /// decides the query.
  bool meets_end(const Vec3<double>& nd, const Vec3<double>& of_b) {
    const CorePair& pair = query_.pair;
    if (is_along(pair.a, nd, flat)) {
      const bool above = nd.z() > 0;
      const Vec3<double> m(0, 0, above ? 1 : -1);
      const double rim = above ? pair.a.size.y() : pair.a.size.x();
      const bool is_decided = meets_disk(m, rim, [&](const DifferencePoint& found, double t) {
        const Vec3<double> at = found.c + found.a + t * query_.velocity;
        return Landing{at.x(), at.y(), {at.x(), at.y(), found.a.z()}};
      });
      if (is_decided) return true;
    }
    if (!is_along(pair.b, of_b, flat)) return false;
    const bool above = of_b.z() > 0;
    const Vec3<double> m = pair.turn.col(2) * (above ? -1 : 1);
    const double rim = above ? pair.b.size.y() : pair.b.size.x();
    return meets_disk(m, rim, [&](const DifferencePoint& found, double t) {
      const Vec3<double> at = pair.to_b(found.a - pair.x - t * query_.velocity);
      return Landing{at.x(), at.y(), found.a};
    });
  }

  /// Place in a disk's plane where a core arrives, in the disk's frame, and the point of A there.
  struct Landing {
    double x, y;
    Vec3<double> a;
  };

  /// Same for a disk with the radius `rim` and the normal m. land(point, t) returns the place where
  /// the furthest point of the other core is at the time t.
  template <class Land>
  bool meets_disk(const Vec3<double>& m, double rim, const Land& land) {
    const double approach = -m.dot(query_.velocity);
    if (!(approach > 0)) return false;
    const DifferencePoint found = query_.nearest(m);
    const double gap = m.dot(found.c) - query_.radius;
    if (query_.judge(m, 1, gap)) return true;
    const double t = (gap + query_.rounding) / approach;
    const Landing at = land(found, t);
    const double within = rim - 4 * query_.rounding * (1 + query_.speed / approach);
    if (!(within > 0) || at.x * at.x + at.y * at.y > within * within) return false;
    query_.lower_t_hi(t, at.a + query_.pair.a.radius * m);
    return query_.has_met() && query_.end_hit();
  }

  /// Computes the next normal and its weights.
  bool advance(const AcrossMotion& S, double damping, Vec3<double>& nd) {
    const double least = query_.size * (damping + 1e-9);
    const double b00 = S.xx + least, b01 = S.xy, b11 = S.yy + least,
                 inverse = 1 / (b00 * b11 - b01 * b01);
    const double i00 = b11 * inverse, i11 = b00 * inverse, i01 = -b01 * inverse;
    double best[4] = {1, 0, 0, 0};
    if (count_ > 1) {
      double Q[4][4];
      for (int j = 0; j < count_; ++j) {
        const double up = i00 * p_[j] + i01 * q_[j], uq = i01 * p_[j] + i11 * q_[j];
        for (int i = 0; i <= j; ++i) Q[i][j] = p_[i] * up + q_[i] * uq;
      }
      if (!least_of_subsets(Q, best)) return false;
    }
    double p = 0, q = 0;
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      if (!(best[i] > 0)) continue;
      p += best[i] * p_[i];
      q += best[i] * q_[i];
      feature_a_[kept] = feature_a_[i];
      feature_b_[kept] = feature_b_[i];
      weight_[kept] = best[i];
      t_[kept] = t_[i];
      p_[kept] = p_[i];
      q_[kept++] = q_[i];
    }
    count_ = kept;
    double m0 = i00 * p + i01 * q, m1 = i01 * p + i11 * q;
    level(m0, m1);
    nd += m0 * query_.e0 + m1 * query_.e1;
    return kept > 0;
  }

  /// Ends the search with a hit at the normal nd. For derivatives, takes another step first, exact
  /// for the same features: its error is about the square of its length.
  bool end_hit(const AcrossMotion& S, bool is_known, const Vec3<double>& nd) {
    if (!query_.is_for_derivatives || !is_known) return query_.end_hit();
    double m0 = 0, m1 = 0, curvature = query_.size;  // the least that matters
    if (count_ == 1) {
      const double determinant = S.xx * S.yy - S.xy * S.xy;
      curvature = determinant / (S.xx + S.yy);
      m0 = (S.yy * p_[0] - S.xy * q_[0]) / determinant;
      m1 = (S.xx * q_[0] - S.xy * p_[0]) / determinant;
    } else if (count_ == 2) {
      // Along the line between the points, both have to give the same bound.
      const double p1 = p_[1] - p_[0], q1 = q_[1] - q_[0], length = std::sqrt(p1 * p1 + q1 * q1);
      const double x = p1 / length, y = q1 / length, along = (t_[0] - t_[1]) / length;
      curvature = S.xx * y * y - 2 * S.xy * x * y + S.yy * x * x;
      const double coupled = (S.yy - S.xx) * x * y + S.xy * (x * x - y * y);
      const double across = (x * q_[0] - y * p_[0] - coupled * along) / curvature;
      m0 = along * x - across * y;
      m1 = along * y + across * x;
    } else {
      level(m0, m1);
    }
    constexpr double of_square = 30, of_rounding = 1e-12;
    const double length = nd.norm(), turn = std::sqrt(m0 * m0 + m1 * m1) / length;
    const double error =
        of_square * turn * turn + query_.rounding / (curvature * length) + of_rounding;
    if (error <= query_.small_axis_error && curvature > 0)
      query_.take_axis(nd + m0 * query_.e0 + m1 * query_.e1, error);
    return query_.end_hit();
  }

  /// Corrects the step m so that all features give the same bound. If curvatures are small, their
  /// inverses magnify the weights' rounding errors.
  void level(double& m0, double& m1) const {
    if (count_ < 2) return;
    const double p1 = p_[1] - p_[0], q1 = q_[1] - q_[0], off1 = t_[0] - t_[1] - (p1 * m0 + q1 * m1);
    if (count_ == 2) {
      const double k = off1 / (p1 * p1 + q1 * q1);
      m0 += k * p1;
      m1 += k * q1;
      return;
    }
    const double p2 = p_[2] - p_[0], q2 = q_[2] - q_[0], off2 = t_[0] - t_[2] - (p2 * m0 + q2 * m1),
                 area = p1 * q2 - q1 * p2;
    m0 += (off1 * q2 - q1 * off2) / area;
    m1 += (p1 * off2 - off1 * p2) / area;
  }

  /// Finds weights w >= 0 with sum 1 that minimise t.w + w Q w / 2. Q has rank 2, so at most three
  /// weights are not 0. Only the upper triangle of Q is set.
  bool least_of_subsets(const double (*Q)[4], double* best) const {
    const double* const t = t_;
    double least = std::numeric_limits<double>::infinity();
    const auto take = [&](double value, int i, double u, int j, double v, int k, double w) {
      if (!(value < least)) return;
      least = value;
      best[0] = best[1] = best[2] = best[3] = 0;
      best[i] += u;
      best[j] += v;
      best[k] += w;
    };
    for (int a = 0; a < count_; ++a) {
      const double at_a = t[a] + 0.5 * Q[a][a];
      take(at_a, a, 1, a, 0, a, 0);
      for (int b = a + 1; b < count_; ++b) {
        const double bb = Q[a][a] - 2 * Q[a][b] + Q[b][b], to_b = t[b] - t[a] + Q[a][b] - Q[a][a];
        if (to_b < 0 && -to_b < bb) {
          const double x = -to_b / bb;
          take(at_a + 0.5 * to_b * x, a, 1 - x, b, x, a, 0);
        }
        for (int c = b + 1; c < count_; ++c) {
          const double cc = Q[a][a] - 2 * Q[a][c] + Q[c][c],
                       bc = Q[a][a] - Q[a][b] - Q[a][c] + Q[b][c],
                       to_c = t[c] - t[a] + Q[a][c] - Q[a][a], area = bb * cc - bc * bc;
          const double at_b = bc * to_c - cc * to_b, at_c = bc * to_b - bb * to_c;
          if (!(at_b > 0 && at_c > 0 && at_b + at_c < area)) continue;
          const double y = at_b / area, z = at_c / area;
          take(at_a + 0.5 * (to_b * y + to_c * z), a, 1 - y - z, b, y, c, z);
        }
      }
    }
    return least < std::numeric_limits<double>::infinity();
  }

  /// Tries to prove an upper bound of the time at the best normal nd, by three points whose
  /// projections enclose the origin: points on the features or, if `is_known` (no other feature
  /// gives a lower bound), support points in nearby directions.
  bool settle(const Vec3<double>& nd, bool is_known) {
    const double length = nd.norm();
    double turn = (query_.near > 0 ? turn_if_near : least_turn) * length;
    SweptPoint f[4];
    const auto on_feature = [&](int i, const Vec3<double>& d) {
      return query_.on_features(feature_a_[i], feature_b_[i], d);
    };
    if (count_ == 2) {
      const double ep = p_[1] - p_[0], eq = q_[1] - q_[0], edge = std::sqrt(ep * ep + eq * eq);
      if (edge > 0) {
        const Vec3<double> across = (turn / edge) * (-eq * query_.e0 + ep * query_.e1);
        for (int i = 0; i < 4; ++i)
          f[i] = on_feature(i & 1, i < 2 ? Vec3<double>(nd - across) : Vec3<double>(nd + across));
        pierce_any(f, 4);
      }
    } else if (count_ > 2) {
      const Vec3<double> growth = (query_.pair.a.radius / length) * nd;
      for (int i = 0; i < count_; ++i)
        f[i] = query_.in_shadow(y_[i], a_[i] + growth, feature_a_[i], feature_b_[i]);
      pierce_any(f, count_);
    }
    if (query_.has_met()) return query_.end_hit();
    for (int tries = 0; is_known && count_ < 3 && tries < 3; ++tries, turn *= 30) {
      constexpr double cosine[3] = {1, -0.5, -0.5},
                       sine[3] = {0, 0.8660254037844386, -0.8660254037844386};
      for (int i = 0; i < 3; ++i)
        f[i] = query_.support(nd + (turn * cosine[i]) * query_.e0 + (turn * sine[i]) * query_.e1);
      if (query_.pierce(f[0], f[1], f[2])) break;
    }
    return query_.has_met() && query_.end_hit();
  }

  void pierce_any(const SweptPoint* f, int count) {
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < count; ++j)
        for (int k = j + 1; k < count; ++k) query_.pierce(f[i], f[j], f[k]);
  }

  SweptQuery<A, B>& query_;
  Vec3<double> e0_in_b_ = query_.pair.to_b(query_.e0), e1_in_b_ = query_.pair.to_b(query_.e1);
  bool is_end_tried_ = false;
  int count_ = 0;
  int feature_a_[4], feature_b_[4];
  double weight_[4];
  double t_[4], p_[4], q_[4];  ///< bounds of the features, and their points' projections
  Vec3<double> y_[4], a_[4];   ///< points of the features, of C and of A's core
};

}  // namespace minkray
