// SPDX-License-Identifier: MIT
// The jet cast: a ray cast that asks a shape for its support point and curvature, and solves
// exactly for the hit on the hull of the few ellipsoids so found. Where the shape is made of flat
// faces, edges and pieces of ellipsoids it ends after finitely many support calls, elsewhere it
// converges as Newton's method does. docs/theory.md has the mathematics.
//
// Every support plane gives a rigorous lower bound of the hit; the loop ends when the model's hit
// lies no further than rounding beyond the best of these bounds. Should it not get there, the GJK
// ray cast answers instead.
#pragma once

#include "core/shape/support_mapped.h"
#include "core/solver/gjk_ray_cast.h"
#include "core/solver/hull_model.h"

namespace minkray {

template <class T>
struct JetCastOptions {
  int max_iterations = tolerance::jet_max_iterations;
};

namespace detail {

/// An orthonormal frame whose third row is -r (Duff et al., "Building an Orthonormal Basis,
/// Revisited", 2017).
template <class T>
Mat3<T> frame_along(const Vec3<T>& r) {
  const Vec3<T> z = -r;
  const T sign = std::copysign(T(1), z.z());
  const T a = T(-1) / (sign + z.z());
  const T b = z.x() * z.y() * a;
  Mat3<T> Q;
  Q << T(1) + sign * z.x() * z.x() * a, sign * b, -sign * z.x(),  //
      b, sign + z.y() * z.y() * a, -z.y(),                        //
      z.x(), z.y(), z.z();
  return Q;
}

/// Where the whole line meets the shape first, in units of the bounding radius.
template <class T>
struct LineHit {
  Status status = Status::exhausted;
  T lambda = -std::numeric_limits<T>::infinity();       ///< a lower bound, rigorous
  T lambda_above = std::numeric_limits<T>::infinity();  ///< the model's hit
  Vec3<T> normal = Vec3<T>::Zero();
  int supports = 0;
};

/// The line s + lambda r in units of the radius: Q's third row is -r, s is at right angles to it.
/// Gives up on what lies beyond lambda_end.
template <class T, class S, class Observer>
LineHit<T> first_on_line(const S& shape, const Ball<T>& ball, const Vec3<T>& half_extents,
                         const Vec3<T>& s, const Mat3<T>& Q, T lambda_end, int max_iterations,
                         Observer&& observer) {
  constexpr T gap = tolerance::jet_gap<T>;
  LineHit<T> result;
  const T scale = T(1) / ball.radius;
  const Vec3<T> s_frame = Q * s;  // z is zero but for rounding, which the lambdas then share

  // The first direction: the normal where the ray meets the ellipsoid of the shape's extents.
  const Mat3<T> around = Q * (half_extents * scale).asDiagonal();
  HullModel<T> model(around);
  Vec3<T> n = CommonFactorCast<T>(around, {Vec3<T>(-s_frame)}, 1).solve(0).m;
  if (!(n.squaredNorm() > T(0))) n = Vec3<T>::UnitZ();

  T shrink = T(0.5);
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    // The supporting plane of direction n: it clips the line, or separates.
    const Jet<T> jet = shape.jet(Vec3<T>(Q.transpose() * n));
    ++result.supports;
    Piece<T> piece;
    piece.c = Q * ((jet.c - ball.centre) * scale) - s_frame;
    piece.F = Q * (jet.F * scale);
    piece.exact = jet.exact;
    piece.n = n;
    piece.patch = piece.c;
    const Vec3<T> bent = piece.F.transpose() * n;
    const Vec3<T> g = piece.F * unit(bent);
    if (jet.exact) {
      piece.s = piece.c + g;
    } else {
      piece.s = Q * ((jet.s - ball.centre) * scale) - s_frame;
      piece.c = piece.s - g;
    }
    const T h = jet.exact ? piece.c.dot(n) + bent.norm() : piece.s.dot(n);
    const T lambda = n.z() > T(0) ? -h / n.z() : -std::numeric_limits<T>::infinity();
    observer(lambda, n, piece.s);
    if (lambda > result.lambda) {
      result.lambda = lambda;
      result.normal = n;
    }
    const bool separates = !(n.z() > T(0)) && h < -gap;
    if (separates || lambda > lambda_end) {
      result.status = Status::miss;
      result.normal = n;
      return result;
    }

    // The hit on the hull of the pieces so far.
    const bool repeated = model.add(piece);
    if (repeated) shrink *= T(0.1);
    if (iteration >= 3) shrink *= T(0.5);
    HullSolution<T> solution = model.solve(n, shrink);
    if (!solution.certain && (solution.m - n).squaredNorm() <= tolerance::epsilon<T>) {
      model.flatten_older();
      solution = model.solve(n, shrink);
    }
    if (!(solution.m.squaredNorm() > T(0))) return result;  // exhausted
    if (solution.certain) {
      const T cosine = std::min(solution.m.z(), std::max(result.normal.z(), T(0)));
      const T missing = (-solution.height - result.lambda) * cosine;
      if (missing < -T(16) * gap) return result;  // contradicts a supporting plane: exhausted
      if (missing <= gap * (repeated ? T(4) : T(1))) {
        result.status = Status::hit;
        if (model.is_exact(solution))
          result.lambda_above = std::max(-solution.height, result.lambda);
        return result;
      }
    }
    // A tangent line: where along it the shape is touched, no plane along it tells.
    if (!(n.z() > T(0)) && repeated && std::abs(h) <= gap) return result;
    model.keep(solution);
    n = solution.m;
  }
  return result;
}

}  // namespace detail

/// The least parameter at which the ray lies in the shape. `ball` must hold the shape, and the ray
/// be given relative to the ball's centre; `half_extents` are those of its axis-aligned bounds.
template <class T, class S, class Observer = NoObserver>
requires JetMapped<S, T> CastResult<T> jet_cast(const S& shape, const RayNearBall<T>& near,
                                                const Ball<T>& ball, const Vec3<T>& half_extents,
                                                const JetCastOptions<T>& options = {},
                                                Observer&& observer = {}) {
  CastResult<T> result;
  result.t_base = near.t_base;
  const auto fall_back = [&] {
    CastResult<T> slow = gjk_ray_cast<T>(shape, near, ball, {}, observer);
    slow.iterations += result.iterations;
    slow.supports += result.supports;
    return slow;
  };
  const T R = ball.radius;
  if (!(R > T(0)) || !(near.r.squaredNorm() > T(0))) return fall_back();

  // The bounding ball.
  const T nearest = std::clamp(T(0), near.lambda_min, near.lambda_max);
  const Vec3<T> to_ray = near.s + nearest * near.r;
  if (to_ray.norm() > R * (T(1) + tolerance::ball_padding<T>)) {
    result.status = Status::miss;
    result.normal = unit(to_ray);
    return result;
  }
  const Mat3<T> Q = detail::frame_along(near.r);
  const Vec3<T> s = near.s / R;
  const T depth = std::sqrt(std::max(T(1) - s.squaredNorm(), T(0))) + tolerance::ball_padding<T>;

  const auto watch = [&](const Mat3<T>& frame, T direction) {
    return [&observer, &near, R, frame, direction](T lambda, const Vec3<T>& n, const Vec3<T>& p) {
      const T at = direction * lambda * R;
      const Vec3<T> x = near.s + at * near.r;
      const Vec3<T> point = near.s + frame.transpose() * p * R;
      observer(CastIteration<T>{at, x, frame.transpose() * n, point, x - point,
                                std::span<const Vec3<T>>()});
    };
  };
  const auto count = [&](const detail::LineHit<T>& hit) {
    result.supports += hit.supports;
    result.iterations += hit.supports;
  };
  const auto miss = [&](const Vec3<T>& normal) {
    result.status = Status::miss;
    result.normal = normal;
    return result;
  };

  const T end = std::min(depth, near.lambda_max / R);
  const auto entry = detail::first_on_line<T>(shape, ball, half_extents, s, Q, end,
                                              options.max_iterations, watch(Q, T(1)));
  count(entry);
  if (entry.status == Status::exhausted) return fall_back();
  const Vec3<T> normal = Q.transpose() * entry.normal;
  if (entry.status == Status::miss) {
    // Beyond the ball's far side: joined with the ball's own plane there, the two leave the line no
    // room, and their sum runs along it.
    const bool beyond_ball = entry.normal.z() > T(0) && end == depth;
    if (!beyond_ball) return miss(normal);
    const Vec3<T> out = s + depth * near.r;
    const T along = out.dot(near.r);
    if (!(along > T(0))) return miss(normal);
    return miss(unit<T>(normal + out * (entry.normal.z() / along)));
  }
  const auto hit_at = [&](const detail::LineHit<T>& hit) {
    result.t_offset = result.offset_lo = near.t_offset(hit.lambda * R);
    result.offset_hi = near.t_offset(hit.lambda_above * R);
    result.normal = normal;
  };
  if (entry.lambda * R >= near.lambda_min) {
    hit_at(entry);
    result.status = Status::hit;
    return result;
  }

  // The line enters before the ray begins: where does it leave?
  Mat3<T> back = Q;
  back.row(0) = Q.row(1);
  back.row(1) = Q.row(0);
  back.row(2) = -Q.row(2);
  const auto exit =
      detail::first_on_line<T>(shape, ball, half_extents, s, back, -near.lambda_min / R,
                               options.max_iterations, watch(back, T(-1)));
  count(exit);
  if (exit.status == Status::exhausted) return fall_back();
  if (exit.status == Status::miss || -exit.lambda * R < near.lambda_min)
    return miss(back.transpose() * exit.normal);
  result.status = Status::inside;
  result.t_offset = result.offset_lo = result.offset_hi = near.t_offset(near.lambda_min);
  return result;
}

}  // namespace minkray
