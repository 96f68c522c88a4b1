// SPDX-License-Identifier: MIT
// Finds the time of impact of curved cores with quadratic convergence, by sequential quadratic
// programming. Let u be the direction of motion. A supporting plane of C (swept_query.h) with the
// normal n, scaled so that n.u = -1, gives a lower bound of the time. The bound is the minimum of
// one function of n per feature (sliding_features.h). This bound is concave in n; its maximum is
// the time of impact.
#pragma once

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

  /// Searches from the normal `first`, which faces against the motion. Returns true if the search
  /// decided the query.
  bool run(const Vec3<double>& first) {
    Vec3<double> nd = first / -first.dot(query_.along);
    double damping = 0.1;  // relative to the size; pairs of a face and a rim need it
    for (int step = 0; step < most_turns; ++step, damping = step < 7 ? damping * 0.1 : 0) {
      const CorePair& pair = query_.pair;
      const DifferencePoint found = query_.nearest(nd);
      const double length = nd.norm();
      const Vec3<double> n = nd / length;
      const SweptPoint w =
          query_.grown_along(n, found.c, found.a, found.feature_a, found.feature_b);
      if (query_.judge(nd, w)) return true;
      if (query_.has_met()) return query_.end_hit();
      const Vec3<double> of_b = pair.to_b(-nd);
      if (is_along_an_end(nd, of_b)) return false;
      Symmetric S;
      SweptPoint z[4];
      double p = 0, q = 0;
      bool is_known = false;
      for (int i = 0; i < count_; ++i) {
        const int on_a = feature_a_[i], on_b = feature_b_[i];
        const bool is_same_a = on_a == w.feature_a, is_same_b = on_b == w.feature_b;
        const Vec3<double> a = is_same_a ? found.a : point_of_feature<A>(pair.a, on_a, nd),
                           b = is_same_b ? found.b : point_of_feature<B>(pair.b, on_b, of_b);
        z[i] = is_same_a && is_same_b
                   ? w
                   : query_.grown_along(n, pair.x + pair.turn * b - a, a, on_a, on_b);
        p += weight_[i] * z[i].p;
        q += weight_[i] * z[i].q;
        is_known |= is_same_a && is_same_b;
        add_curvature<A>(S, weight_[i], pair.a, Mat3<double>::Identity(), on_a, nd, a);
        add_curvature<B>(S, weight_[i], pair.b, pair.turn, on_b, of_b, b);
      }
      // The curvature of a ball.
      const double of_radius = query_.radius / length;
      S.xx += of_radius;
      S.yy += of_radius;
      S.zz += of_radius;
      S.add(-of_radius, n);
      constexpr double stationary = 3e-8;
      if (is_known && p * p + q * q <= stationary * stationary * query_.size * query_.size)
        return surround(nd, z);
      if (!is_known) {
        if (count_ == 4) return false;
        z[count_] = w;
        append(w.feature_a, w.feature_b, 0);
      }
      if (!advance(S, z, damping, nd)) return false;
    }
    return false;
  }

 private:
  static constexpr int most_turns = 12;

  void append(int feature_a, int feature_b, double weight) {
    feature_a_[count_] = feature_a;
    feature_b_[count_] = feature_b;
    weight_[count_++] = weight;
  }

  /// True if nd is the normal of a flat end, where the support point jumps. Only the portal can
  /// then continue.
  bool is_along_an_end(const Vec3<double>& nd, const Vec3<double>& of_b) const {
    constexpr double flat = 1e-6;
    const auto is_along = [](const ShapeCore& core, const Vec3<double>& d) {
      return core.kind == CoreKind::disks && d.x() * d.x() + d.y() * d.y() < flat * d.squaredNorm();
    };
    return is_along(query_.pair.a, nd) || is_along(query_.pair.b, of_b);
  }

  /// Computes the next normal and its weights.
  bool advance(const Symmetric& S, const SweptPoint* z, double damping, Vec3<double>& nd) {
    const Vec3<double> s0 = S * query_.e0, s1 = S * query_.e1;
    const double least = query_.size * (damping + 1e-9);
    const double b00 = query_.e0.dot(s0) + least, b01 = query_.e0.dot(s1),
                 b11 = query_.e1.dot(s1) + least, inverse = 1 / (b00 * b11 - b01 * b01);
    const double i00 = b11 * inverse, i11 = b00 * inverse, i01 = -b01 * inverse;
    double t[4], Q[4][4];
    for (int j = 0; j < count_; ++j) {
      t[j] = nd.dot(z[j].y);
      const double up = i00 * z[j].p + i01 * z[j].q, uq = i01 * z[j].p + i11 * z[j].q;
      for (int i = 0; i <= j; ++i) Q[i][j] = z[i].p * up + z[i].q * uq;
    }
    double best[4];
    if (!least_of_subsets(t, Q, best)) return false;
    double p = 0, q = 0;
    for (int i = 0; i < count_; ++i) {
      p += best[i] * z[i].p;
      q += best[i] * z[i].q;
    }
    nd += (i00 * p + i01 * q) * query_.e0 + (i01 * p + i11 * q) * query_.e1;
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      if (!(best[i] > 0)) continue;
      feature_a_[kept] = feature_a_[i];
      feature_b_[kept] = feature_b_[i];
      weight_[kept++] = best[i];
    }
    count_ = kept;
    return kept > 0;
  }

  /// Finds weights w >= 0 with sum 1 that minimise t.w + w Q w / 2. Q has rank 2, so at most three
  /// weights are not 0. Only the upper triangle of Q is set.
  bool least_of_subsets(const double* t, const double (*Q)[4], double* best) const {
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

  /// Tries to prove an upper bound of the time at the best normal nd, by three support points in
  /// nearby directions whose projections enclose the origin.
  bool surround(const Vec3<double>& nd, const SweptPoint* z) {
    const double length = nd.norm();
    double turn = 3e-6 * length;
    if (count_ == 2) {
      const double ep = z[1].p - z[0].p, eq = z[1].q - z[0].q, edge = std::sqrt(ep * ep + eq * eq);
      if (edge > 0) {
        const Vec3<double> across = (turn / edge) * (-eq * query_.e0 + ep * query_.e1);
        const SweptPoint f[4] = {query_.on_features(feature_a_[0], feature_b_[0], nd - across),
                                 query_.on_features(feature_a_[1], feature_b_[1], nd - across),
                                 query_.on_features(feature_a_[0], feature_b_[0], nd + across),
                                 query_.on_features(feature_a_[1], feature_b_[1], nd + across)};
        pierce_any(f, 4);
      }
    } else if (count_ > 2) {
      pierce_any(z, count_);
    }
    if (query_.has_met()) return query_.end_hit();
    for (int tries = 0; tries < 3; ++tries, turn *= 30) {
      constexpr double cosine[3] = {1, -0.5, -0.5},
                       sine[3] = {0, 0.8660254037844386, -0.8660254037844386};
      SweptPoint f[3];
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
  int count_ = 0;
  int feature_a_[4], feature_b_[4];
  double weight_[4];
};

}  // namespace minkray
