// SPDX-License-Identifier: MIT
// Casts for rays whose position relative to the shape has an error of up to RayNearBall::loss
// (core/query/ray_near_ball.h), so that results hold for all parallel rays within that distance.
// The parameter at which parallel rays enter a convex shape is a convex function of their position.
// So if rays through the corners of a triangle enter the shape, all rays between them enter it, at
// the t of the last of the three or before.
#pragma once

#include <algorithm>

#include "core/cast/stages.h"
#include "core/query/ray_frame.h"

namespace minkray {

/// Three rays parallel to a given ray, through the corners of a triangle that contains all rays
/// within the loss.
class RaysAround {
 public:
  static constexpr int count = 3;

  explicit RaysAround(const RayNearBall<double>& near) : near_(near), frame_(near.r) {}

  RayNearBall<double> operator[](int corner) const {
    // The circumscribed circle has twice the radius of the inscribed one; 2.125 allows for
    // rounding.
    constexpr double to_corner = 2.125, half = 0.5, sine = 0.8660254037844386;
    const double cosines[count] = {1.0, -half, -half}, sines[count] = {0.0, sine, -sine};
    RayNearBall<double> moved = near_;
    moved.s += (frame_.x * cosines[corner] + frame_.y * sines[corner]) * (to_corner * near_.loss);
    moved.loss = 0.0;
    return moved;
  }

  /// Returns the ray at a corner, with a beginning that is later and an end that is earlier by the
  /// loss.
  RayNearBall<double> shorter(int corner) const {
    RayNearBall<double> moved = (*this)[corner];
    moved.lambda_min += near_.loss;
    moved.lambda_max -= near_.loss;
    return moved;
  }
  /// Returns the ray at a corner, with a beginning that is earlier (sign = -1) or later (1) by the
  /// loss.
  RayNearBall<double> beginning(int corner, int sign) const {
    RayNearBall<double> moved = (*this)[corner];
    moved.lambda_min += sign * near_.loss;
    return moved;
  }

 private:
  const RayNearBall<double>& near_;
  RayFrame<double> frame_;
};

/// Casts by `ask(near)`, which treats the ray's position as exact. Returns `exhausted` if rays
/// within the loss may have another status.
template <class Ask>
CastResult<double> ask_within_loss(const PreparedShape& shape, const RayNearBall<double>& near,
                                   const Ask& ask) {
  const Ball<double>& ball = shape.inner_ball();
  RayNearBall<double> exact = near;
  exact.loss = 0.0;
  CastResult<double> found = ask(exact);
  const auto give_up = [&] {
    found.status = Status::exhausted;
    found.normal.setZero();
    return found;
  };
  const auto answer = [&](const RayNearBall<double>& beside) {
    const CastResult<double> other = ask(beside);
    found.iterations += other.iterations;
    found.supports += other.supports;
    return other;
  };
  const RaysAround around(near);

  if (found.status == Status::miss) {
    // The plane must be further from the ray than the loss wherever the shape may be.
    const double reach = 2.0 * (ball.radius + near.loss);
    const auto height_at = [&](double lambda) {
      return found.normal.dot(near.s + near.r * std::clamp(lambda, -reach, reach));
    };
    ++found.supports;
    const double of_shape =
        found.normal.dot(shape.inner_shape().support(found.normal) - ball.centre);
    const double margin =
        std::min(height_at(near.lambda_min), height_at(near.lambda_max)) - of_shape;
    return margin > near.loss + tolerance::jet_gap<double> * ball.radius ? found : give_up();
  }
  if (found.status == Status::inside) {
    for (int corner = 0; corner < RaysAround::count; ++corner)
      for (const int sign : {-1, 1})
        if (answer(around.beginning(corner, sign)).status != Status::inside) return give_up();
    return found;
  }
  if (found.status == Status::hit) {
    // For reversed rays t decreases along the ray.
    const double sign = near.t_per_length < 0.0 ? -1.0 : 1.0;
    const double first = std::min(sign * found.offset_lo, sign * found.t_offset);
    double latest = sign * found.t_offset;
    for (int corner = 0; corner < RaysAround::count; ++corner) {
      const CastResult<double> other = answer(around.shorter(corner));
      if (other.status != Status::hit) return give_up();
      latest = std::max(latest, sign * other.offset_hi);
    }
    if (!(latest < std::numeric_limits<double>::infinity())) return give_up();
    // Around a point, a convex function falls by at most as much as it rises on the opposite side.
    // The ray may also be displaced along itself.
    const double along = near.loss * std::abs(near.t_per_length);
    found.offset_hi = sign * (latest + along);
    found.offset_lo = sign * (2.0 * first - latest - along);
  }
  return found;
}

}  // namespace minkray
