// SPDX-License-Identifier: MIT
// A shape made ready to be cast at many times: affine maps around it are pulled out, so that the
// solver works in the innermost frame with as few and as exact operations as possible, and the
// bounding ball is computed once.
#pragma once

#include "core/math/affine.h"
#include "core/math/bounds.h"
#include "core/shape/shape.h"
#include "core/shape/shape_bounds.h"
#include "core/solver/model_of.h"
#include "core/solver/ray_near_ball.h"

namespace minkray {

/// "Inner" is the frame of `shape` after all outer transforms are taken off, "outer" the frame the
/// rays come in.
template <class T>
class PreparedShape {
 public:
  /// `pose` maps the frame of `shape` to the outer one; it must be invertible.
  explicit PreparedShape(Shape<T> shape, const Affine<T>& pose = {})
      : shape_(std::move(shape)), bounds_(bounds_of<T>(Transform<T>{Nested<T>(shape_), pose})) {
    Affine<T> to_outer = pose;
    while (const auto* transform = std::get_if<Transform<T>>(&shape_.kind)) {
      to_outer = to_outer * transform->map.affine();
      Shape<T> inner = *transform->shape;
      shape_ = std::move(inner);
    }
    to_inner_ = inverse_of(to_outer.linear);
    Bounds<T> inner_bounds = bounds_of<T>(shape_);
    // Very small and very large shapes are brought to about unit size by a power of two, which is
    // exact: solvers multiply up to four lengths, and must not leave the range of T.
    const T size = inner_bounds.half_extents().maxCoeff();
    if (size > T(0) && !(size >= T(1) / ordinary_size && size <= ordinary_size)) {
      const T down = std::ldexp(T(1), -std::ilogb(size)), up = std::ldexp(T(1), std::ilogb(size));
      shape_ = Transform<T>{Nested<T>(shape_), Affine<T>{Mat3<T>::Identity() * down, {0, 0, 0}}};
      to_outer.linear *= up;
      to_inner_ *= down;
      inner_bounds = bounds_of<T>(shape_);
    }
    ball_ = ball_around(inner_bounds);
    half_extents_ = inner_bounds.half_extents();
    centre_ = to_outer(ball_.centre);
    model_ = model_kind_of<T>(shape_);
    surface_ = surface_of<T>(shape_);
    is_rigid_identity_ = to_outer.linear == Mat3<T>::Identity();
  }

  const Shape<T>& inner_shape() const { return shape_; }
  const Ball<T>& inner_ball() const { return ball_; }
  /// Of the inner shape's axis-aligned bounds.
  const Vec3<T>& inner_half_extents() const { return half_extents_; }
  const Bounds<T>& outer_bounds() const { return bounds_; }

  /// What the inner shape's surface is made of.
  SurfaceKind surface() const { return surface_; }

  /// What the solvers on jets model it as.
  ModelKind model() const { return model_; }

  /// The ray in the inner frame, relative to the ball's centre; W is T or a packet of it.
  template <class W>
  RayNearBall<W> to_inner(const Ray<W>& ray) const {
    const RayNearBall<W> near = ray_near(centre_, ray);
    return is_rigid_identity_ ? near : near.mapped(to_inner_);
  }

  /// An inner normal in the outer frame, of unit length.
  template <class W>
  Vec3<W> normal_to_outer(const Vec3<W>& normal) const {
    return is_rigid_identity_ ? normal : unit<W>(times<W, T>(to_inner_.transpose(), normal));
  }

  /// The other way, of any length; for hints, not for hot code.
  Vec3<T> normal_to_inner(const Vec3<T>& normal) const {
    return is_rigid_identity_ ? normal : Vec3<T>(to_inner_.transpose().inverse() * normal);
  }

 private:
  /// Fourth powers of it, with room for the square of epsilon, are in the range of T.
  static constexpr T ordinary_size = std::is_same_v<T, float> ? T(0x1p16) : T(0x1p128);

  Shape<T> shape_;
  Ball<T> ball_;
  Vec3<T> half_extents_;
  Bounds<T> bounds_;
  Vec3<T> centre_;
  Mat3<T> to_inner_;
  SurfaceKind surface_;
  ModelKind model_;
  bool is_rigid_identity_;
};

}  // namespace minkray
