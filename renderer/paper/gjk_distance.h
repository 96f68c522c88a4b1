// SPDX-License-Identifier: MIT
// The GJK distance algorithm: Algorithm 2 of van den Bergen (2004), section 3, in 2D and 3D.
// Letters: v is the simplex' point closest to the origin, w the support point s(-v), Y the simplex
// with w, W the smallest subset of Y whose convex hull contains v. The obstacle is C = {x} - (A -
// B), where x is the offset of the objects' centres or, if B is a point, the query point.
#pragma once

#include <array>
#include <type_traits>

#include "core/gjk/simplex.h"
#include "core/query/observer.h"
#include "renderer/paper/distance_result.h"
#include "renderer/paper/tolerances.h"

namespace minkray {

/// A support point of A along v and one of B along -v.
template <class T, int Dim>
struct SupportPair {
  Vec<T, Dim> a, b;
};

template <class T, int Dim>
struct DistanceOptions {
  /// Difference of the bounds at which the search ends; for the unit see tolerance::distance_gap.
  T gap = tolerance::distance_gap<T>;
  int max_iterations = tolerance::distance_max_iterations;
  /// Initial direction from A to B, such as the previous frame's axis; zero for none.
  Vec<T, Dim> v0 = Vec<T, Dim>::Zero();
  /// True to decide only whether the objects are separated: ends at the first separating plane,
  /// with a lower bound but no distance (the paper's "separating-axis variant").
  bool only_separation = false;
};

/// `supports(v)` returns SupportPair<T, Dim>, each point relative to its object's centre. x is the
/// vector from A's centre to B's; `radius` is an upper bound of |a - b| for points a of A and b of
/// B, each relative to its centre. Points of the result are relative to A's centre.
template <class T, int Dim, class Supports, class G = Simplex<T, Dim>, class Observer = NoObserver>
DistanceResult<T, Dim> gjk_distance(const Supports& supports, const Vec<T, Dim>& x, T radius,
                                    const DistanceOptions<T, Dim>& options = {}, G Y = {},
                                    Observer&& observer = {}) {
  using Vector = Vec<T, Dim>;
  DistanceResult<T, Dim> result;
  std::array<SupportPair<T, Dim>, G::slots> pairs;
  ClosestPoint<T, Dim> closest;
  T v_squared = std::numeric_limits<T>::infinity();
  T gap = std::numeric_limits<T>::infinity();

  Vector v = options.v0;
  if (!(v.squaredNorm() > T(0))) v = x;
  if (!(v.squaredNorm() > T(0))) v = Vector::UnitX();
  Y.begin(x);

  const auto finish = [&](DistanceStatus status) {
    result.status = status;
    // Divides the weights by their sum, so that the point stays on the simplex. On a short edge
    // the weights have large rounding errors, which move the point along the edge only.
    T sum = T(0);
    for (const T weight : closest.weights) sum += weight;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!(closest.kept & (1u << i))) continue;
      result.point_a += closest.weights[i] / sum * pairs[i].a;
      result.point_b += closest.weights[i] / sum * pairs[i].b;
    }
    result.point_b += x;
    if (status == DistanceStatus::overlapping) {
      result.lower = T(0);
      result.axis.setZero();
      return result;
    }
    result.distance = closest.v.norm();
    result.lower = std::min(result.lower, result.distance);
    result.certificate = std::max(gap, T(0));
    return result;
  };
  // Ends the search: v is close enough, or rounding prevents further progress.
  const auto stalled = [&] {
    if (result.lower > tolerance::gjk_rounding<T> * radius)
      return finish(DistanceStatus::separated);
    const bool touches = !(std::sqrt(v_squared) > tolerance::gjk_stalled<T> * radius);
    return finish(touches ? DistanceStatus::overlapping : DistanceStatus::exhausted);
  };

  while (result.iterations < options.max_iterations) {
    ++result.iterations;
    ++result.supports;
    const SupportPair<T, Dim> pair = supports(v);
    const Vector p = pair.a - pair.b;
    const Vector w = x - p;
    const Vector v_asked = v;
    const T v_w = v.dot(w), v_norm = v.norm();
    if (const T bound = v_w / v_norm; bound > result.lower) {
      result.lower = bound;
      result.axis = v / v_norm;
    }
    if (options.only_separation && v_w > T(0)) {
      result.status = DistanceStatus::separated;
      result.distance = std::numeric_limits<T>::infinity();
      return result;
    }

    // Tests if v is close enough to the obstacle's point closest to the origin. The first v may not
    // be a point of the obstacle, so this v is not tested.
    const unsigned before = Y.used();
    bool is_close_enough = false;
    if (before != 0) {
      gap = v_squared - v_w;
      is_close_enough = gap <= options.gap * v_norm * (v_norm + radius);
    }
    const bool repeated = Y.holds(p);
    int slot = -1;
    if (!is_close_enough && !repeated) {
      slot = Y.add(p);
      pairs[static_cast<std::size_t>(slot)] = pair;
      const ClosestPoint<T, Dim> answer = Y.closest();
      if (!answer.proper) ++result.backups;
      const T squared = answer.v.squaredNorm();
      if (squared < v_squared) {
        closest = answer;
        v_squared = squared;
        v = answer.v;
        Y.keep(answer.kept);
      } else {
        slot = -1;  // No progress; the previous result's vertices are still in their slots.
      }
    }

    if constexpr (!std::is_same_v<std::remove_cvref_t<Observer>, NoObserver>) {
      std::array<Vector, G::slots> was, is;
      std::size_t n_was = 0, n_is = 0;
      for (int i = 0; i < G::slots; ++i) {
        const Vector y = x - Y.p(i);
        if (before & (1u << i)) was[n_was++] = y;
        if (closest.kept & (1u << i)) is[n_is++] = y;
      }
      observer(DistanceIteration<T, Dim>{v_asked, w, v, result.lower, v.norm(),
                                         std::span<const Vector>(was.data(), n_was),
                                         std::span<const Vector>(is.data(), n_is)});
    }

    if (is_close_enough || slot < 0) return stalled();
    if (Y.full() || std::sqrt(v_squared) <= tolerance::gjk_rounding<T> * radius)
      return finish(DistanceStatus::overlapping);
  }
  return finish(DistanceStatus::exhausted);
}

}  // namespace minkray
