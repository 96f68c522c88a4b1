// SPDX-License-Identifier: MIT
// The ray's hit on the hull of a few pieces of any kind: closed forms where the pieces share one
// factor, a Newton iteration on their osculating common ellipsoid where they do not. No support
// calls are made here.
#pragma once

#include <array>

#include "core/shape/jet.h"
#include "core/solver/hull_cast.h"
#include "core/solver/tolerances.h"

namespace minkray {

/// One ellipsoid { c + F b : |b| <= 1 }, or a point where F = 0.
template <class T>
struct HullPiece {
  Vec3<T> c = Vec3<T>::Zero();
  Mat3<T> F = Mat3<T>::Zero();
  bool exact = true;                ///< part of the shape, not only osculating
  Vec3<T> s = Vec3<T>::Zero();      ///< its support point when it was found
  Vec3<T> n = Vec3<T>::Zero();      ///< the direction, of unit length, in which it was found
  Vec3<T> patch = Vec3<T>::Zero();  ///< what tells the pieces of one curved patch: its centre

  T value(const Vec3<T>& m) const { return c.dot(m) + (F.transpose() * m).norm(); }
  bool is_point() const { return (F.array() == T(0)).all(); }
};

/// Which pieces carry the model's hit, and with which weights.
template <class T>
struct HullSolution {
  Vec3<T> m = Vec3<T>::Zero();       ///< the direction, of unit length; zero: none was found
  int size = 0;                      ///< how many pieces carry it
  std::array<int, 4> carriers = {};  ///< their indices
  std::array<T, 4> weights = {};     ///< convex weights of their support points
  T height = T(0);                   ///< of the hit on the axis, where m.z > 0
  bool certain = false;              ///< `height` is the model's hit, up to rounding
};

/// Frame: the ray runs down the z axis, and lengths are in units of the shape's bounding radius.
template <class T>
class HullModel {
 public:
  /// `surrogate` is a factor of an ellipsoid of about the shape's extents: the curvature that
  /// points are given while no triangle of them encloses the ray.
  explicit HullModel(const Mat3<T>& surrogate) : surrogate_(surrogate) {}

  int size() const { return size_; }
  const HullPiece<T>& piece(int i) const { return pieces_[static_cast<std::size_t>(i)]; }

  /// Adds a piece, replacing the same piece where it is there already, and says whether it was.
  /// Osculating pieces keep their ellipsoids only if they belong to different patches (different
  /// centre) and were found in nearly the same direction; older ones become their support points,
  /// which are part of the shape whatever the curvature.
  bool add(const HullPiece<T>& piece) {
    for (int i = 0; i < size_; ++i) {
      const HullPiece<T>& old = at(i);
      if (old.patch == piece.patch || (old.n - piece.n).squaredNorm() > near_squared)
        flatten(at(i));
    }
    bool repeated = false;
    newest_ = size_;
    for (int i = 0; i < size_; ++i) {
      if (at(i).c != piece.c || at(i).F != piece.F || !piece.exact) continue;
      newest_ = i;
      repeated = true;
    }
    if (newest_ == 4) newest_ = 3;
    at(newest_) = piece;
    size_ = std::max(size_, newest_ + 1);
    return repeated;
  }

  /// The hit on the hull of the pieces, near direction n. `shrink` scales the surrogate curvature.
  HullSolution<T> solve(const Vec3<T>& n, T shrink) {
    bool common = true, points = true;
    for (int i = 0; i < size_; ++i) {
      common = common && at(i).F == at(0).F;
      points = points && at(i).is_point();
    }
    if (points) return solve_points(n, shrink);
    HullSolution<T> solution = common ? translates(at(0).F, centres(), newest_) : solve_mixed(n);
    solution.certain = solution.certain && has_settled(solution, n);
    return solution;
  }

  /// Whether no carrier of the solution is merely osculating.
  bool is_exact(const HullSolution<T>& solution) const {
    bool exact = true;
    for (int k = 0; k < solution.size; ++k)
      exact = exact && at(solution.carriers[static_cast<std::size_t>(k)]).exact;
    return exact;
  }

  /// Turns all osculating pieces but the newest into their support points.
  void flatten_older() {
    for (int i = 0; i < size_; ++i)
      if (i != newest_) flatten(at(i));
  }

  /// Drops all pieces but the carriers of the solution.
  void keep(const HullSolution<T>& solution) {
    std::array<HullPiece<T>, 4> kept;
    int count = 0;
    for (int k = 0; k < solution.size; ++k)
      kept[static_cast<std::size_t>(count++)] = at(solution.carriers[static_cast<std::size_t>(k)]);
    pieces_ = kept;
    size_ = count;
  }

  /// The support points of the solution's carriers in its direction, combined by their weights: the
  /// point of the shape that the solution claims to be the hit.
  Vec3<T> spot(const HullSolution<T>& solution) const {
    Vec3<T> p = Vec3<T>::Zero();
    for (int k = 0; k < solution.size; ++k) {
      const auto index = static_cast<std::size_t>(k);
      const HullPiece<T>& carrier = pieces_[static_cast<std::size_t>(solution.carriers[index])];
      p += solution.weights[index] *
           (carrier.c + carrier.F * unit<T>(carrier.F.transpose() * solution.m));
    }
    return p;
  }

 private:
  static void flatten(HullPiece<T>& piece) {
    if (!piece.exact)
      piece = HullPiece<T>{piece.s, Mat3<T>::Zero(), true, piece.s, piece.n, piece.s};
  }

  HullPiece<T>& at(int i) { return pieces_[static_cast<std::size_t>(i)]; }
  const HullPiece<T>& at(int i) const { return pieces_[static_cast<std::size_t>(i)]; }

  std::array<Vec3<T>, 4> centres() const {
    std::array<Vec3<T>, 4> c;
    for (int i = 0; i < 4; ++i) c[static_cast<std::size_t>(i)] = at(i).c;
    return c;
  }

  /// The hit on translates of one ellipsoid, the newest among its carriers.
  HullSolution<T> translates(const Mat3<T>& F, const std::array<Vec3<T>, 4>& c, int newest) const {
    Translates<T> others;
    std::array<int, 3> index = {};
    std::size_t count = 0;
    for (int i = 0; i < size_; ++i) {
      if (i == newest) continue;
      others.c[count] = c[static_cast<std::size_t>(i)];
      others.valid[count] = true;
      index[count++] = i;
    }
    const Vec3<T>& c_newest = c[static_cast<std::size_t>(newest)];
    const bool points = (F.array() == T(0)).all();
    const HullCastHit<T> hit =
        points ? HullCast<T, RoundBody<T>>({T(0)}, c_newest, others, rounding).solve()
               : HullCast<T, EllipsoidBody<T>>({F}, c_newest, others, rounding).solve();
    HullSolution<T> solution;
    if (!(hit.m.squaredNorm() > T(0))) return solution;
    solution.m = hit.m;
    solution.height = hit.rank;
    solution.certain = hit.found && hit.m.z() > T(0);
    T rest = T(1);
    for (std::size_t k = 0; k < 3; ++k) {
      if (hit.weights[k] == T(0)) continue;
      rest -= hit.weights[k];
      const auto place = static_cast<std::size_t>(solution.size++);
      solution.carriers[place] = index[k];
      solution.weights[place] = hit.weights[k];
    }
    const auto place = static_cast<std::size_t>(solution.size++);
    solution.carriers[place] = newest;
    solution.weights[place] = rest;
    return solution;
  }

  /// The same with any of them among the carriers: the first that is certain, or the lowest.
  HullSolution<T> any_translates(const Mat3<T>& F, const std::array<Vec3<T>, 4>& c) const {
    HullSolution<T> best;
    for (int i = size_ - 1; i >= 0; --i) {
      const HullSolution<T> solution = translates(F, c, i);
      if (solution.size == 0) continue;
      if (best.size == 0 || solution.height < best.height) best = solution;
      if (solution.certain) return solution;
    }
    return best;
  }

  /// Points only: the triangle that encloses the ray, or else the same points made round.
  HullSolution<T> solve_points(const Vec3<T>& n, T shrink) const {
    const HullSolution<T> flat = translates(Mat3<T>::Zero(), centres(), newest_);
    if (flat.certain || shrink < least_shrink) return flat;
    // The ellipsoids touch the planes of direction n in the points themselves.
    const Mat3<T> F = surrogate_ * shrink;
    const Vec3<T> g = F * unit<T>(F.transpose() * n);
    std::array<Vec3<T>, 4> c = centres();
    for (Vec3<T>& centre : c) centre -= g;
    HullSolution<T> round = translates(F, c, newest_);
    round.certain = false;
    return round;
  }

  /// Pieces of different factors. In direction m with weights mu, the pieces' curvatures are joined
  /// into one ellipsoid, shifted for each piece to touch at its own support point; its closed form
  /// gives the next m and mu. Full steps: a line search stalls on curved kinks.
  HullSolution<T> solve_mixed(const Vec3<T>& n) const {
    Vec3<T> m = n;
    std::array<T, 4> mu = {};
    for (int i = 0; i < size_; ++i) mu[static_cast<std::size_t>(i)] = T(1) / T(size_);
    HullSolution<T> solution;
    for (int step = 0; step < newton_steps; ++step) {
      std::array<Vec3<T>, 4> g, c;
      Vec3<T> g_mean = Vec3<T>::Zero();
      T h_mean = T(0);
      Mat3<T> H = Mat3<T>::Zero();
      for (int i = 0; i < size_; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Vec3<T> u = at(i).F.transpose() * m;
        const T h = u.norm();
        g[k] = Vec3<T>::Zero();
        if (!(h > T(0))) continue;
        g[k] = at(i).F * (u / h);
        H += (mu[k] / h) * (at(i).F * at(i).F.transpose() - g[k] * g[k].transpose());
        g_mean += mu[k] * g[k];
        h_mean += mu[k] * h;
      }
      for (int i = 0; i < size_; ++i) {
        const auto k = static_cast<std::size_t>(i);
        c[k] = at(i).c + g[k] - g_mean;
      }
      const Mat3<T> F = factor<T>(h_mean * H + g_mean * g_mean.transpose());
      const HullSolution<T> next = any_translates(F, c);
      if (next.size == 0) return solution;
      const T moved = (next.m - m).norm();
      const bool same = next.size == solution.size && next.carriers == solution.carriers;
      m = next.m;
      mu = {};
      for (int k = 0; k < next.size; ++k)
        mu[static_cast<std::size_t>(next.carriers[static_cast<std::size_t>(k)])] =
            next.weights[static_cast<std::size_t>(k)];
      solution = next;
      if (same && moved <= settled) break;
    }
    judge(solution);
    return solution;
  }

  /// Where osculating pieces carry the solution, it is the shape's hit only if support points prove
  /// it: their combination p lies in the shape, hardly below the newest supporting plane and hardly
  /// beside the ray. What Newton's method would still gain is half the product of its step and the
  /// distance beside the ray.
  bool has_settled(const HullSolution<T>& solution, const Vec3<T>& n) const {
    if (is_exact(solution)) return true;
    Vec3<T> p = Vec3<T>::Zero();
    for (int k = 0; k < solution.size; ++k) {
      const auto index = static_cast<std::size_t>(k);
      p += solution.weights[index] * at(solution.carriers[index]).s;
    }
    const T beside = std::hypot(p.x(), p.y());
    const T below = n.dot(at(newest_).s - p);
    return below + beside * (solution.m - n).norm() <= agreed && beside <= model_reach;
  }

  /// Whether the solution is the model's hit up to rounding: all carriers agree, nothing reaches
  /// further, and the carriers' support points combine to a point on the ray.
  void judge(HullSolution<T>& solution) const {
    solution.certain = false;
    if (!(solution.m.z() > T(0))) return;
    T highest = -std::numeric_limits<T>::infinity(), mean = T(0);
    for (int i = 0; i < size_; ++i) highest = std::max(highest, at(i).value(solution.m));
    for (int k = 0; k < solution.size; ++k) {
      const auto index = static_cast<std::size_t>(k);
      mean += solution.weights[index] * at(solution.carriers[index]).value(solution.m);
    }
    const Vec3<T> p = spot(solution);
    solution.height = mean / solution.m.z();
    solution.certain = highest - mean <= agreed && std::hypot(p.x(), p.y()) <= on_the_ray;
  }

  /// Up to about 15 degrees between their directions, the ellipsoids of two patches go together.
  static constexpr T near_squared = T(1) / T(16);
  static constexpr int newton_steps = 8;
  static constexpr T epsilon = std::numeric_limits<T>::epsilon();
  /// Where the surrogate is so small, the points are taken as they are.
  static constexpr T least_shrink = T(1e-3);
  /// How little the direction moves (of 1) when the iteration, which converges quadratically, has
  /// used up the digits: the value's error is the square.
  inline static const T settled = T(2) * std::sqrt(epsilon);
  /// In units of the bounding radius: rounding of a value.
  static constexpr T agreed = T(4) * epsilon;
  /// In units of the bounding radius: the value's error is its square over the radius of curvature.
  inline static const T on_the_ray = T(0.6) * std::sqrt(epsilon);

  /// In units of the bounding radius.
  static constexpr T rounding = tolerance::model_rounding<T>;
  /// In units of the bounding radius: how close to the ray an osculating ellipsoid is trusted.
  inline static const T model_reach = std::cbrt(epsilon);

  Mat3<T> surrogate_;
  std::array<HullPiece<T>, 4> pieces_;
  int size_ = 0;
  int newest_ = 0;
};

}  // namespace minkray
