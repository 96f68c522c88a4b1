// SPDX-License-Identifier: MIT
// Casting a ray exactly on the convex hull of at most four ellipsoids: the model that the jet cast
// solves between two support calls. docs/theory.md derives the closed forms.
//
// Frame: the ray runs down the z axis, from +z to -z, and lengths are in units of the shape's
// bounding radius. For a direction m with m.z > 0, the supporting plane of the hull cuts the axis
// at height value(m)/m.z, and the hit is the lowest of these heights over all m: the minimum of a
// convex function of (m.x/m.z, m.y/m.z). m.z = 0 with value(m) < 0 separates hull and ray.
#pragma once

#include <array>

#include "core/math/vec.h"

namespace minkray {

/// One ellipsoid { c + F b : |b| <= 1 }, or a point where F = 0.
template <class T>
struct Piece {
  Vec3<T> c = Vec3<T>::Zero();
  Mat3<T> F = Mat3<T>::Zero();
  bool exact = true;                ///< part of the shape, not only osculating
  Vec3<T> s = Vec3<T>::Zero();      ///< its support point when it was found
  Vec3<T> n = Vec3<T>::Zero();      ///< the direction, of unit length, in which it was found
  Vec3<T> patch = Vec3<T>::Zero();  ///< what tells the pieces of one curved patch: its centre

  T value(const Vec3<T>& m) const { return c.dot(m) + (F.transpose() * m).norm(); }
  bool is_point() const { return (F.array() == T(0)).all(); }
};

/// A few pieces; which of them carry the solution, and with which weights.
template <class T>
struct HullSolution {
  Vec3<T> m = Vec3<T>::Zero();       ///< the direction, of unit length; zero: none was found
  int size = 0;                      ///< how many pieces carry it
  std::array<int, 3> carriers = {};  ///< their indices
  std::array<T, 3> weights = {};     ///< convex weights of their support points
  T height = T(0);                   ///< of the hit on the axis, where m.z > 0
  bool certain = false;              ///< `height` is the model's hit, up to rounding
};

/// The closed forms for pieces that share one factor F: hull of {c_i} plus the ellipsoid F.
template <class T>
class CommonFactorCast {
 public:
  CommonFactorCast(const Mat3<T>& F, const std::array<Vec3<T>, 4>& c, int count)
      : F_(F), c_(c), count_(count), is_flat_((F.array() == T(0)).all()) {}

  /// The hit, with piece `newest` among its carriers; among the candidates whose weights are not
  /// negative and that no other piece beats, or, should rounding leave none, the best by value.
  HullSolution<T> solve(int newest) const { return solve_among(newest, newest); }

  /// The same with any piece among the carriers.
  HullSolution<T> solve_any() const { return solve_among(0, count_ - 1); }

 private:
  HullSolution<T> solve_among(int first, int last) const {
    HullSolution<T> best;
    T best_rank = std::numeric_limits<T>::infinity();
    bool done = false;
    const auto consider = [&](HullSolution<T> candidate, bool feasible) {
      const T length = candidate.m.norm();
      if (!(length > T(0)) || !std::isfinite(length)) return;
      candidate.m /= length;
      const T bent = (F_.transpose() * candidate.m).norm();
      T carried = -std::numeric_limits<T>::infinity(), value = carried;
      for (int k = 0; k < candidate.size; ++k)
        carried = std::max(
            carried, at(candidate.carriers[static_cast<std::size_t>(k)]).dot(candidate.m) + bent);
      for (int k = 0; k < count_; ++k) value = std::max(value, at(k).dot(candidate.m) + bent);
      const T beaten_by = value - carried;
      constexpr T rounding = T(8) * std::numeric_limits<T>::epsilon();
      // A direction across the ray is worth taking only if it separates.
      const bool across = !(candidate.m.z() > T(0));
      if (across && !(value < T(0)) && !is_flat_) feasible = false;
      const T rank = (feasible ? T(0) : T(1e3)) +
                     (across ? (value < T(0) ? T(-10) : T(100)) : value / candidate.m.z());
      candidate.height = across ? T(0) : value / candidate.m.z();
      candidate.certain = feasible && !across && beaten_by <= rounding;
      if (feasible && beaten_by <= rounding) {
        best = candidate;
        done = true;
      } else if (rank < best_rank) {
        best_rank = rank;
        best = candidate;
      }
    };
    for (int i = first; i <= last && !done; ++i) one(i, consider);
    for (int i = first; i <= last; ++i)
      for (int j = 0; j < count_ && !done; ++j)
        if (j < first || j > i) two(i, j, consider);
    for (int i = first; i <= last; ++i)
      for (int j = 0; j < count_; ++j)
        for (int k = j + 1; k < count_ && !done; ++k)
          if ((j < first || j > i) && (k < first || k > i)) three(i, j, k, consider);
    return best;
  }

  const Vec3<T>& at(int i) const { return c_[static_cast<std::size_t>(i)]; }

  /// The lateral position of the ellipsoid's support point in direction m. By way of a unit vector,
  /// so that it is a point of the ellipsoid even where F^T m is nothing but rounding.
  Vec3<T> lateral(const Vec3<T>& m) const {
    Vec3<T> g = F_ * unit<T>(F_.transpose() * m);
    g.z() = T(0);
    return g;
  }

  /// Ray and ellipsoid.
  template <class Consider>
  void one(int i, Consider&& consider) const {
    const T qx = at(i).x(), qy = at(i).y();
    HullSolution<T> found;
    found.size = 1;
    found.carriers = {i};
    found.weights = {T(1)};
    if (is_flat_) {
      found.m = {-qx, -qy, T(0)};
      consider(found, qx != T(0) || qy != T(0));
      return;
    }
    // With q = c_xy, N_kl = f_k x f_l and m_kl = N_kl.z: det = sum m^2, adj q and the rest of A's
    // minors are sums of products of these, which keep the digits that A itself loses for needles.
    T det = T(0), off = T(0);
    Vec3<T> across = Vec3<T>::Zero(), adj = Vec3<T>::Zero();
    for (int k = 0; k < 3; ++k) {
      for (int l = k + 1; l < 3; ++l) {
        const Vec3<T> N = F_.col(k).cross(F_.col(l));
        det += N.z() * N.z();
        across += N.z() * N;
      }
      const T moment = F_(0, k) * qy - F_(1, k) * qx;
      off += moment * moment;
      adj += moment * Vec3<T>(-F_(1, k), F_(0, k), T(0));
    }
    const T volume = std::abs(F_.col(0).dot(F_.col(1).cross(F_.col(2))));
    const T den = det - off;
    found.m = den > T(0) ? Vec3<T>(std::sqrt(den) * across - volume * adj) : Vec3<T>(-adj);
    consider(found, true);
  }

  /// Ray and the elliptic cylinder between two ellipsoids.
  template <class Consider>
  void two(int i, int j, Consider&& consider) const {
    const Vec3<T> e = at(i) - at(j);
    const T E = e.x() * e.x() + e.y() * e.y();
    if (!(E > T(0))) return;
    const T root_E = std::sqrt(E);
    const Vec3<T> t(-e.y() / root_E, e.x() / root_E, T(0));
    const Vec3<T> w = unit<T>({-e.x() * (e.z() / E), -e.y() * (e.z() / E), T(1)});
    const Vec3<T> yw = F_.transpose() * w, yt = F_.transpose() * t;
    const T ga = yt.squaredNorm(), et = yw.dot(yt), D = yw.cross(yt).norm();
    const T L = -t.dot(at(i));
    const T den = ga - L * L;
    HullSolution<T> found;
    found.size = 2;
    found.carriers = {i, j};
    if (den > T(0)) {
      const T root = std::sqrt(den);
      found.m = ga * root * w + (L * D - et * root) * t;
    } else {
      found.m = L < T(0) ? Vec3<T>(-t) : t;
    }
    Vec3<T> G = lateral(found.m);
    if (!(den > T(0)) && ga > T(0)) {
      const Vec3<T> along = F_ * (F_.transpose() * found.m);
      G = Vec3<T>(along.x(), along.y(), T(0)) * (std::abs(L) / ga);
    }
    const Vec3<T> from = at(j) + G;
    const T weight = -(from.x() * e.x() + from.y() * e.y()) / E;
    found.weights = {weight, T(1) - weight};
    // Where the ellipsoids are flat and the plane along the cylinder is theirs, G is any of their
    // points; it counts only if it lies across from the ray.
    const bool on_the_ray = !(den > T(0)) || std::abs(t.dot(from)) <= lateral_rounding;
    consider(found, on_the_ray && weight >= T(0) && weight <= T(1));
  }

  /// Ray and the plane that touches three ellipsoids.
  template <class Consider>
  void three(int i, int j, int k, Consider&& consider) const {
    const Vec3<T> ab = at(j) - at(i), ac = at(k) - at(i), bc = at(k) - at(j);
    Vec3<T> m = ab.squaredNorm() < bc.squaredNorm() ? ab.cross(ac) : bc.cross(ac);
    if (m.z() < T(0)) m = -m;
    if (!(m.z() > T(0))) return;
    HullSolution<T> found;
    found.m = m;
    found.size = 3;
    found.carriers = {i, j, k};
    const Vec3<T> G = lateral(m);
    const Vec3<T> a = at(i) + G, b = at(j) + G, c = at(k) + G;
    const auto area = [](const Vec3<T>& p, const Vec3<T>& q) {
      return p.x() * q.y() - p.y() * q.x();
    };
    const T at_a = area(b, c), at_b = area(c, a), at_c = area(a, b);
    const T sum = at_a + at_b + at_c;
    if (sum == T(0)) return;
    found.weights = {at_a / sum, at_b / sum, at_c / sum};
    consider(found,
             found.weights[0] >= T(0) && found.weights[1] >= T(0) && found.weights[2] >= T(0));
  }

  /// In units of the bounding radius: twice the digits of a value, whose error is the square.
  inline static const T lateral_rounding = T(4) * std::sqrt(std::numeric_limits<T>::epsilon());

  Mat3<T> F_;
  std::array<Vec3<T>, 4> c_;
  int count_;
  bool is_flat_;
};

}  // namespace minkray
