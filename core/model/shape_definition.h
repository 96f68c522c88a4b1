// SPDX-License-Identifier: MIT
// Data shared by all instances of one shape: the innermost shape with its bounding ball and
// precomputed data for the solvers. Instances refer to it, so that a hull is stored once for any
// number of instances.
#pragma once

#include <memory>

#include "core/derived/ellipsoid_sum.h"
#include "core/exact/form.h"
#include "core/math/affine.h"
#include "core/math/bounds.h"
#include "core/math/two_fold.h"
#include "core/model/model_kind.h"
#include "core/query/tolerances.h"
#include "core/shape/shape.h"

namespace minkray {

/// Immutable. "Inner" refers to the shape without its outer transforms, and to its frame.
template <class T>
class ShapeDefinition {
 public:
  explicit ShapeDefinition(Shape<T> shape);

  const Shape<T>& original_shape() const { return *original_; }
  const Shape<T>& inner_shape() const { return inner_; }
  const Ball<T>& inner_ball() const { return ball_; }
  /// Half extents of the inner shape's axis-aligned bounds, around the ball's centre.
  const Vec3<T>& inner_half_extents() const { return half_extents_; }
  ModelKind model() const { return model_; }
  /// The inner shape, if model() is a sum of ellipsoids.
  const EllipsoidSum<T>& ellipsoid_sum() const { return ellipsoid_sum_; }
  /// True if casts at the shape are proven one by one, in double, before they are returned.
  bool is_extreme() const { return is_extreme_; }
  bool is_lost_in_rounding() const { return is_lost_in_rounding_; }
  /// The inner shape in double, made on first use, for float shapes with casts that fall back to
  /// double. Null for smooth shapes without a closed form, and for needles that are lost in
  /// rounding.
  const ShapeDefinition<double>* in_double() const;
  /// True if all float casts in which the filter is in doubt are repeated in double, not only hits
  /// at planes nearly along the ray. True for extreme shapes, flat slivers and shapes with a form.
  /// False for polytopes, since few casts are uncertain and facets take much memory; except plates
  /// that are flat up to rounding.
  bool is_asked_in_double() const { return is_asked_in_double_; }
  /// The inner shape of extreme shapes in long double; null for others.
  const Shape<long double>* in_long_double() const { return in_long_double_.get(); }
  /// The inner shape's closed form, if it declares one. Extreme shapes have none.
  const exact::Form& form() const { return form_; }
  /// Hits are checked again if the component of their normal against the ray is less than this;
  /// zero if the surface is known to have neither corners nor flat faces.
  T uncertain_slope() const { return uncertain_slope_; }
  /// True if the ball's centre is the origin of the shape's own frame: its place under a pose is
  /// then the pose's translation.
  bool is_centred() const { return middle_.is_zero(); }
  /// Excess of the support points' rounding over that of their distance from the ball's centre,
  /// including the rounding of maps that may have moved them all: a length in the inner frame.
  T support_loss() const { return support_loss_; }
  bool has_large_loss() const { return support_loss_ > tolerance::small_loss<T> * ball_.radius; }
  /// True if rays can be cast at the shape in packets.
  bool has_packets() const {
    if (form_.kind != FormKind::none) return true;  // an extreme shape has none
    return !is_extreme_ && !is_sliver_ && !is_lost_in_rounding_ && !has_large_loss() &&
           model_ != ModelKind::osculating_sums;
  }

  /// Bounds of the whole shape, with its transforms, under a pose.
  Bounds<T> bounds_of(const Affine<T>& pose) const;

  /// Place of an instance. Each number of `to_inner` is rounded about once.
  struct Placement {
    TwoFoldVec3<T> centre;   ///< centre of the inner ball, in the frame of the pose
    Mat3<T> to_inner;        ///< map of directions
    bool is_rigid_identity;  ///< to_inner is the identity, or its rotation of a ball is ignored
    /// The pose keeps lengths and there is no outer map: to_inner is the transposed linear part of
    /// the pose, and the centre is the inner ball's centre under the pose.
    bool is_plain = false;
    T loss =
        T(0);  ///< bound on the centre's displacement by rounding of the pose, in the inner frame
  };

  /// The ball's centre under a plain pose; its rounded part is what lanes compute.
  static TwoFoldVec3<T> plain_centre(const Affine<T>& pose, const Vec3<T>& ball_centre);
  static Vec3<T> rounded_plain_centre(const Affine<T>& pose, const Vec3<T>& ball_centre) {
    if (ball_centre.isZero(T(0))) return pose.translation;
    return pose.translation + times<T, T>(pose.linear, ball_centre);
  }
  /// Loss of plain placements that are rotated.
  T plain_loss() const { return plain_loss_; }

  /// True if placements under poses that keep lengths are plain.
  bool is_plain() const { return is_plain_; }
  /// True for a ball around the inner frame's origin.
  bool is_round() const { return is_round_; }

  /// `pose` maps the frame of the shape to the outer one; it must be invertible.
  Placement placed(const Affine<T>& pose) const;

 private:
  /// Removes the outer transforms of the shape and adds them to `outer_` and `moved_`.
  void take_off();

  Nested<T> original_;
  Shape<T> inner_;
  TwoFoldMat3<T> outer_;  ///< the shape is outer_ * up * inner + moved_
  TwoFoldVec3<T> moved_;
  TwoFoldVec3<T> middle_;  ///< the ball's centre in the shape's frame
  T moved_loss_ = T(0);    ///< bound on the centre's displacement by rounding of maps
  T up_ = T(1), down_ = T(1);
  Ball<T> ball_;
  Vec3<T> half_extents_;
  ModelKind model_;
  EllipsoidSum<T> ellipsoid_sum_;
  T uncertain_slope_;
  T support_loss_;
  T plain_loss_ = T(0);
  bool is_extreme_;
  bool is_plain_ = false, is_round_ = false;
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
