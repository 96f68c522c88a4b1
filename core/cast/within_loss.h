// SPDX-License-Identifier: MIT
// Casts of rays whose position relative to the shape has an error of up to RayNearBall::loss:
// results hold for every ray within that distance. The parameter at which parallel rays enter a
// convex shape is a convex function of their position: if rays through the corners of a triangle
// enter the shape, so do all rays between them, no later than the latest of the three.
#pragma once

#include <algorithm>

#include "core/cast/stages.h"
#include "core/query/ray_frame.h"

namespace minkray {

/// Three rays parallel to one, at the corners of a triangle that contains all rays within the loss.
template <class T>
class RaysAround {
 public:
  static constexpr int count = 3;

  explicit RaysAround(const RayNearBall<T>& near) : near_(near), frame_(near.r) {}

  RayNearBall<T> operator[](int corner) const {
    // The circumscribed circle has twice the radius of the inscribed one; 2.125 allows for
    // rounding.
    constexpr T to_corner = T(2.125), half = T(0.5), sine = T(0.8660254037844386);
    const T cosines[count] = {T(1), -half, -half}, sines[count] = {T(0), sine, -sine};
    RayNearBall<T> moved = near_;
    moved.s += (frame_.x * cosines[corner] + frame_.y * sines[corner]) * (to_corner * near_.loss);
    moved.loss = T(0);
    return moved;
  }

  /// A corner's ray that begins later and ends earlier by the loss.
  RayNearBall<T> shorter(int corner) const {
    RayNearBall<T> moved = (*this)[corner];
    moved.lambda_min += near_.loss;
    moved.lambda_max -= near_.loss;
    return moved;
  }
  /// A corner's ray that begins earlier or later by the loss (sign = -1 or 1).
  RayNearBall<T> beginning(int corner, int sign) const {
    RayNearBall<T> moved = (*this)[corner];
    moved.lambda_min += T(sign) * near_.loss;
    return moved;
  }

 private:
  const RayNearBall<T>& near_;
  RayFrame<T> frame_;
};

/// Casts by `ask(near)`, which takes the ray's position as exact. Returns `exhausted` if rays
/// within the loss may have another status.
template <class T, class Ask>
CastResult<T> ask_within_loss(const PreparedShape<T>& shape, const RayNearBall<T>& near,
                              const Ask& ask) {
  const Ball<T>& ball = shape.inner_ball();
  RayNearBall<T> exact = near;
  exact.loss = T(0);
  CastResult<T> found = ask(exact);
  const auto give_up = [&] {
    found.status = Status::exhausted;
    found.normal.setZero();
    return found;
  };
  const auto answer = [&](const RayNearBall<T>& beside) {
    const CastResult<T> other = ask(beside);
    found.iterations += other.iterations;
    found.supports += other.supports;
    return other;
  };
  const RaysAround<T> around(near);

  if (found.status == Status::miss) {
    // The plane must be further from the ray than the loss wherever the shape may be.
    const T reach = T(2) * (ball.radius + near.loss);
    const auto height_at = [&](T lambda) {
      return found.normal.dot(near.s + near.r * std::clamp(lambda, -reach, reach));
    };
    ++found.supports;
    const T of_shape = found.normal.dot(shape.inner_shape().support(found.normal) - ball.centre);
    const T margin = std::min(height_at(near.lambda_min), height_at(near.lambda_max)) - of_shape;
    return margin > near.loss + tolerance::jet_gap<T> * ball.radius ? found : give_up();
  }
  if (found.status == Status::inside) {
    for (int corner = 0; corner < RaysAround<T>::count; ++corner)
      for (const int sign : {-1, 1})
        if (answer(around.beginning(corner, sign)).status != Status::inside) return give_up();
    return found;
  }
  if (found.status == Status::hit) {
    // For reversed rays t decreases along the ray.
    const T sign = near.t_per_length < T(0) ? T(-1) : T(1);
    const T first = std::min(sign * found.offset_lo, sign * found.t_offset);
    T latest = sign * found.t_offset;
    for (int corner = 0; corner < RaysAround<T>::count; ++corner) {
      const CastResult<T> other = answer(around.shorter(corner));
      if (other.status != Status::hit) return give_up();
      latest = std::max(latest, sign * other.offset_hi);
    }
    if (!(latest < std::numeric_limits<T>::infinity())) return give_up();
    // A convex function falls below its value in the middle by at most what it rises around it. The
    // ray may also be displaced along itself.
    const T along = near.loss * std::abs(near.t_per_length);
    found.offset_hi = sign * (latest + along);
    found.offset_lo = sign * (T(2) * first - latest - along);
  }
  return found;
}

}  // namespace minkray
