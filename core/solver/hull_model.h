// SPDX-License-Identifier: MIT
// The ray's hit on the hull of a few pieces of any kind: closed forms where the pieces share one
// factor, a Newton iteration on their osculating common ellipsoid where they do not. No support
// calls are made here.
#pragma once

#include "core/shape/jet.h"
#include "core/solver/ellipsoid_hull_cast.h"

namespace minkray {

template <class T>
class HullModel {
 public:
  /// `surrogate` is a factor of an ellipsoid of about the shape's extents: the curvature that
  /// points are given while no triangle of them encloses the ray.
  explicit HullModel(const Mat3<T>& surrogate) : surrogate_(surrogate) {}

  int size() const { return size_; }
  const Piece<T>& piece(int i) const { return pieces_[static_cast<std::size_t>(i)]; }

  /// Adds a piece, replacing the same piece where it is there already, and says whether it was.
  /// Osculating pieces keep their ellipsoids only if they belong to different patches (different
  /// centre) and were found in nearly the same direction; older ones become their support points,
  /// which are part of the shape whatever the curvature.
  bool add(const Piece<T>& piece) {
    for (int i = 0; i < size_; ++i) {
      const Piece<T>& old = at(i);
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
    HullSolution<T> solution =
        common ? CommonFactorCast<T>(at(0).F, centres(), size_).solve(newest_) : solve_mixed(n);
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
    std::array<Piece<T>, 4> kept;
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
      const Piece<T>& carrier = pieces_[static_cast<std::size_t>(solution.carriers[index])];
      p += solution.weights[index] *
           (carrier.c + carrier.F * unit<T>(carrier.F.transpose() * solution.m));
    }
    return p;
  }

 private:
  static void flatten(Piece<T>& piece) {
    if (!piece.exact) piece = Piece<T>{piece.s, Mat3<T>::Zero(), true, piece.s, piece.n, piece.s};
  }

  Piece<T>& at(int i) { return pieces_[static_cast<std::size_t>(i)]; }
  const Piece<T>& at(int i) const { return pieces_[static_cast<std::size_t>(i)]; }

  std::array<Vec3<T>, 4> centres() const {
    std::array<Vec3<T>, 4> c;
    for (int i = 0; i < 4; ++i) c[static_cast<std::size_t>(i)] = at(i).c;
    return c;
  }

  /// Points only: the triangle that encloses the ray, or else the same points made round.
  HullSolution<T> solve_points(const Vec3<T>& n, T shrink) const {
    const HullSolution<T> flat =
        CommonFactorCast<T>(Mat3<T>::Zero(), centres(), size_).solve(newest_);
    if (flat.certain || shrink < least_shrink) return flat;
    // The ellipsoids touch the planes of direction n in the points themselves.
    const Mat3<T> F = surrogate_ * shrink;
    const Vec3<T> g = F * unit<T>(F.transpose() * n);
    std::array<Vec3<T>, 4> c = centres();
    for (Vec3<T>& centre : c) centre -= g;
    HullSolution<T> round = CommonFactorCast<T>(F, c, size_).solve(newest_);
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
      const HullSolution<T> next = CommonFactorCast<T>(F, c, size_).solve_any();
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

  /// In units of the bounding radius: how close to the ray an osculating ellipsoid is trusted.
  inline static const T model_reach = std::cbrt(epsilon);

  Mat3<T> surrogate_;
  std::array<Piece<T>, 4> pieces_;
  int size_ = 0;
  int newest_ = 0;
};

}  // namespace minkray
