// SPDX-License-Identifier: MIT
// What all instances of one shape share: the innermost shape with its bounding ball and what the
// solvers know of it. Instances refer to it, so that a hull is stored once however often it is
// posed.
#pragma once

#include <memory>
#include <vector>

#include "core/exact/form.h"
#include "core/math/affine.h"
#include "core/math/bounds.h"
#include "core/model/model_kind.h"
#include "core/shape/ellipsoid_sum.h"
#include "core/shape/shape.h"

namespace minkray {

/// Immutable once made. "Inner" is the frame of the shape after all outer transforms are taken off.
template <class T>
class ShapeDefinition {
 public:
  explicit ShapeDefinition(Shape<T> shape);

  const Shape<T>& original_shape() const { return *original_; }
  const Shape<T>& inner_shape() const { return inner_; }
  const Ball<T>& inner_ball() const { return ball_; }
  /// They are those of the inner shape's axis-aligned bounds, around the ball's centre.
  const Vec3<T>& inner_half_extents() const { return half_extents_; }
  ModelKind model() const { return model_; }
  /// What the inner shape is, where model() says that it is a sum of ellipsoids.
  const EllipsoidSum<T>& ellipsoid_sum() const { return ellipsoid_sum_; }
  /// Casts at it are proven, one by one and in double, before they are answered.
  bool is_extreme() const { return is_extreme_; }
  bool is_lost_in_rounding() const { return is_lost_in_rounding_; }
  /// It is the inner shape in double, made when it is first asked for, of float shapes of which
  /// some casts are asked there: all but smooth ones without a closed form, and needles that are
  /// lost in rounding. It is null for those.
  const ShapeDefinition<double>* in_double() const;
  /// Whether all casts in float that the filter is in doubt of are asked there, and not only hits
  /// at planes nearly along the ray: those of extreme shapes, flat slivers and what has a form. Not
  /// of polytopes, whose facets would take more memory than the uncertain few are worth, but for
  /// plates that are flat but for rounding.
  bool is_asked_in_double() const { return is_asked_in_double_; }
  /// It is the inner shape of extreme shapes in long double; it is null for others.
  const Shape<long double>* in_long_double() const { return in_long_double_.get(); }
  /// The inner shape's closed form, if it declares one; none of extreme shapes.
  const exact::Form& form() const { return form_; }
  /// Hits whose normal's component against the ray is less are looked at again: none, if it is
  /// known that the surface has neither corners nor flat faces.
  T uncertain_slope() const { return uncertain_slope_; }
  /// Whether packets of rays have a solver of their own.
  bool has_packets() const {
    if (form_.kind != FormKind::none) return true;  // an extreme shape has none
    return !is_extreme_ && !is_sliver_ && !is_lost_in_rounding_ &&
           model_ != ModelKind::osculating_sums;
  }

  /// Bounds of the whole shape (the transforms on) under a pose.
  Bounds<T> bounds_of(const Affine<T>& pose) const;

  /// Where an instance stands.
  struct Placement {
    Vec3<T> centre;    ///< the inner ball's, in the frame of the pose
    Mat3<T> to_inner;  ///< of directions
    bool is_rigid_identity;
    /// The pose keeps lengths and no outer map was taken off: to_inner is the transposed linear part
    /// of the pose, and the centre is the pose of the inner ball's.
    bool is_plain;
  };

  /// `pose` maps the frame of the shape to the outer one; it must be invertible.
  Placement placed(const Affine<T>& pose) const;

 private:
  Vec3<T> centre_under(const Affine<T>& pose) const;

  Nested<T> original_;
  Shape<T> inner_;
  std::vector<Affine<T>> maps_;  ///< taken off, the outermost first
  bool is_recentred_ = false;    ///< the last of them moves points that are far away
  T up_ = T(1), down_ = T(1);
  Ball<T> ball_;
  Vec3<T> half_extents_;
  ModelKind model_;
  EllipsoidSum<T> ellipsoid_sum_;
  T uncertain_slope_;
  bool is_extreme_;
  bool is_lost_in_rounding_ = false;
  bool is_sliver_ = false;
  bool is_asked_in_double_ = false;
  exact::Form form_;
  struct InDouble;
  std::shared_ptr<InDouble> in_double_;
  std::shared_ptr<const Shape<long double>> in_long_double_;
};

extern template class ShapeDefinition<float>;
extern template class ShapeDefinition<double>;

}  // namespace minkray
