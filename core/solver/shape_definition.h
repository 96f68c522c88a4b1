// SPDX-License-Identifier: MIT
// What all instances of one shape share: the innermost shape with its bounding ball and what the
// solvers know of it. Instances refer to it, so that a hull is stored once however often it is
// posed.
#pragma once

#include <vector>

#include "core/math/affine.h"
#include "core/math/bounds.h"
#include "core/shape/shape.h"
#include "core/shape/shape_bounds.h"
#include "core/solver/model_of.h"

namespace minkray {

/// Immutable once made. "Inner" is the frame of the shape after all outer transforms are taken off.
template <class T>
class ShapeDefinition {
 public:
  explicit ShapeDefinition(Shape<T> shape) : original_(shape), inner_(std::move(shape)) {
    while (const auto* transform = std::get_if<Transform<T>>(&inner_.kind)) {
      maps_.push_back(transform->map.affine());
      Shape<T> nested = *transform->shape;
      inner_ = std::move(nested);
    }
    Bounds<T> bounds = minkray::bounds_of<T>(inner_);
    // Very small and very large shapes are brought to about unit size by a power of two, which is
    // exact: solvers multiply up to four lengths, and must not leave the range of T.
    const T size = bounds.half_extents().maxCoeff();
    if (size > T(0) && !(size >= T(1) / ordinary_size && size <= ordinary_size)) {
      down_ = std::ldexp(T(1), -std::ilogb(size));
      up_ = std::ldexp(T(1), std::ilogb(size));
      inner_ = Transform<T>{Nested<T>(inner_), Affine<T>{Mat3<T>::Identity() * down_, {0, 0, 0}}};
      bounds = minkray::bounds_of<T>(inner_);
    }
    ball_ = ball_around(bounds);
    half_extents_ = bounds.half_extents();
    model_ = model_kind_of<T>(inner_);
    surface_ = surface_of<T>(inner_);
  }

  const Shape<T>& inner_shape() const { return inner_; }
  const Ball<T>& inner_ball() const { return ball_; }
  /// Of the inner shape's axis-aligned bounds.
  const Vec3<T>& inner_half_extents() const { return half_extents_; }
  SurfaceKind surface() const { return surface_; }
  ModelKind model() const { return model_; }

  /// Bounds of the whole shape (the transforms on) under a pose.
  Bounds<T> bounds_of(const Affine<T>& pose) const {
    return minkray::bounds_of<T>(Transform<T>{original_, pose});
  }

  /// Where an instance stands.
  struct Placement {
    Vec3<T> centre;    ///< the inner ball's, in the frame of the pose
    Mat3<T> to_inner;  ///< of directions
    bool is_rigid_identity;
  };

  /// `pose` maps the frame of the shape to the outer one; it must be invertible.
  Placement placed(const Affine<T>& pose) const {
    Affine<T> to_outer = pose;
    for (const Affine<T>& map : maps_) to_outer = to_outer * map;
    Placement placement;
    placement.to_inner = inverse_of(to_outer.linear);
    to_outer.linear *= up_;
    placement.to_inner *= down_;
    placement.centre = to_outer(ball_.centre);
    placement.is_rigid_identity = to_outer.linear == Mat3<T>::Identity();
    return placement;
  }

 private:
  /// Fourth powers of it, with room for the square of epsilon, are in the range of T.
  static constexpr T ordinary_size = std::is_same_v<T, float> ? T(0x1p16) : T(0x1p128);

  Nested<T> original_;
  Shape<T> inner_;
  std::vector<Affine<T>> maps_;  ///< taken off, the outermost first
  T up_ = T(1), down_ = T(1);
  Ball<T> ball_;
  Vec3<T> half_extents_;
  SurfaceKind surface_;
  ModelKind model_;
};

}  // namespace minkray
