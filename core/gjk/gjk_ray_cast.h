// SPDX-License-Identifier: MIT
// GJK ray cast: Algorithm 3 of G. van den Bergen, "Ray Casting against General Convex Objects with
// Application to Continuous Collision Detection" (2004), section 4. x = s + lambda r is on the ray;
// p is a support point, w = x - p; P are the simplex' support points, Y = x - P; v is the point of
// Y closest to the origin, and is also the next direction; n is the last v that moved lambda.
// Points are relative to the bounding ball's centre; lambda is 0 at the ray's closest point to it.
#pragma once

#include <array>
#include <span>
#include <type_traits>

#include "core/gjk/simplex.h"
#include "core/math/bounds.h"
#include "core/query/miss_plane.h"
#include "core/query/observer.h"
#include "core/query/ray_near_ball.h"
#include "core/query/result.h"
#include "core/query/tolerances.h"
#include "core/support/support_mapped.h"

namespace minkray {

template <class T>
struct GjkCastOptions {
  /// Limit of |v|^2 at which the cast ends, relative to max|x - p|^2; see tolerance::gjk_squared.
  /// Must be at least the square of the machine epsilon: below that the loop can only end by
  /// stalling.
  T eps_tol = tolerance::gjk_squared<T>;
  int max_iterations = tolerance::gjk_max_iterations;
  /// Initial direction, such as the separating axis of the previous frame; zero for none.
  Vec3<T> v0 = Vec3<T>::Zero();
};

namespace detail {

/// Passes an iteration to the observer, with the support points that the simplex kept.
template <class T, class Observer, class G>
void observe(Observer& observer, const G& Y, CastIteration<T> iteration) {
  if constexpr (!std::is_same_v<Observer, NoObserver> &&
                !std::is_same_v<Observer, const NoObserver>) {
    std::array<Vec3<T>, G::slots> P;
    std::size_t size = 0;
    for (int i = 0; i < G::slots; ++i)
      if (Y.uses(i)) P[size++] = Y.p(i);
    iteration.simplex = std::span<const Vec3<T>>(P.data(), size);
    observer(iteration);
  }
}

}  // namespace detail

/// Returns the least parameter at which the ray is in the shape; if the ray begins inside, the
/// parameter of its origin. `ball` must contain the shape, and the ray must be relative to the
/// ball's centre. `Y` is the distance subalgorithm (subalgorithm.h), which also stores the simplex.
template <class T, class S, class Observer = NoObserver, class G = Simplex<T, 3>>
requires SupportMapped<S, T> CastResult<T> gjk_ray_cast(const S& shape, const RayNearBall<T>& near,
                                                        const Ball<T>& ball,
                                                        const GjkCastOptions<T>& options = {},
                                                        Observer&& observer = {}, G Y = {}) {
  CastResult<T> result;
  const Vec3<T>&s = near.s, &r = near.r;
  result.t_base = near.t_base;
  const auto miss = [&](const Vec3<T>& axis) {
    result.status = Status::miss;
    result.normal = unit(axis);
    return result;
  };

  // Bounding ball: a tangent plane separates a ray that misses the ball. Otherwise the cast begins
  // at the ball's surface, or at the ray's beginning inside it.
  const T nearest = std::clamp(T(0), near.lambda_min, near.lambda_max);
  const Vec3<T> to_ray = s + nearest * r;
  if (to_ray.norm() > ball.radius * (T(1) + tolerance::ball_padding<T>)+near.loss)
    return miss(to_ray);
  const T depth = std::sqrt(std::max(ball.radius * ball.radius - s.squaredNorm(), T(0)));
  const bool from_origin = near.lambda_min >= -depth;
  T lambda = std::max(near.lambda_min, -depth);

  Vec3<T> x = s + lambda * r;
  Vec3<T> n = Vec3<T>::Zero();
  Vec3<T> v = options.v0;
  if (!(v.squaredNorm() > T(0))) v = x;
  if (!(v.squaredNorm() > T(0))) v = -r;
  if (!(v.squaredNorm() > T(0))) v = Vec3<T>::UnitX();
  Y.begin(x);
  bool has_advanced = false;
  T v_squared = std::numeric_limits<T>::infinity();

  const auto finish = [&] {
    if (from_origin && !has_advanced) {
      result.status = Status::inside;
      result.t_offset = result.offset_lo = result.offset_hi = near.t_offset(near.lambda_min);
      return result;
    }
    result.status = Status::hit;
    result.t_offset = result.offset_lo = near.t_offset(lambda);
    result.normal = unit(has_advanced ? n : x);
    return result;
  };

  while (result.iterations < options.max_iterations) {
    ++result.iterations;
    ++result.supports;
    const Vec3<T> p = shape.support(v) - ball.centre;
    const Vec3<T> w = x - p;
    const Vec3<T> v_asked = v;
    const auto show = [&] {
      detail::observe(observer, Y, CastIteration<T>{lambda, x, v_asked, p, w, {}});
    };

    // v is a normal at p, so the plane through p may clip the ray.
    bool advanced = false;
    if (const T v_w = v.dot(w); v_w > T(0)) {
      const T v_r = v.dot(r);
      if (!(v_r < T(0))) {
        show();
        // The ray before x is separated by the plane that clipped last or, if none did, by the
        // ball's tangent plane at the start of the cast.
        if (from_origin && !has_advanced) return miss(v);
        return miss(joined_plane(v, has_advanced ? n : x, r));
      }
      const T clipped = lambda - v_w / v_r;
      if (clipped > near.lambda_max) {
        show();
        return miss(v);
      }
      // Clipped beyond the ball's far side: the ball's tangent plane there separates the rest of
      // the ray.
      if (clipped > depth + tolerance::ball_padding<T> * ball.radius) {
        show();
        return miss(joined_plane(Vec3<T>(s + depth * r), v, r));
      }
      advanced = clipped > lambda;
      if (advanced) {
        lambda = clipped;
        x = s + lambda * r;
        Y.move(x);
        n = v;
        has_advanced = true;
      }
    }

    // Adds p to the simplex unless the simplex has it: as the paper permits, p may recur after a
    // clip.
    const bool repeated = Y.holds(p);
    const int slot = repeated ? -1 : Y.add(p);
    const T furthest = Y.furthest_squared();

    // The closest point of the simplex, and the vertices that it lies between.
    const ClosestPoint<T, 3> closest = Y.closest();
    Y.keep(closest.kept);
    v = closest.v;
    show();

    const bool unchanged = repeated || !Y.uses(slot);

    // Ends if v is close enough to zero, or as close as rounding allows.
    const T previous = v_squared;
    v_squared = v.squaredNorm();
    const T v_size = std::sqrt(v_squared) / ball.radius;
    if (v_squared <= options.eps_tol * furthest || v_size <= tolerance::gjk_rounding<T> || Y.full())
      return finish();
    if (!advanced && (unchanged || !(v_squared < previous))) {
      if (v_size <= tolerance::gjk_stalled<T>) return finish();
      if (unchanged) break;
    }
  }
  result.t_offset = result.offset_lo = near.t_offset(lambda);
  result.normal = unit(n);
  return result;
}

}  // namespace minkray
