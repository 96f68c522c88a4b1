// SPDX-License-Identifier: MIT
// Data shared by all instances of one shape: the innermost shape with its bounding ball, and
// precomputed data for the solvers. A hull is thus stored only once for any number of instances.
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

struct SumOfCores;

/// Immutable. "Inner" refers to the shape without its outer transforms, and to its frame.
class ShapeDefinition {
 public:
  explicit ShapeDefinition(Shape shape);

  const Shape& original_shape() const { return *original_; }
  const Shape& inner_shape() const { return inner_; }
  const Ball<double>& inner_ball() const { return ball_; }
  /// Half extents of the inner shape's axis-aligned bounds, around the ball's centre.
  const Vec3<double>& inner_half_extents() const { return half_extents_; }
  ModelKind model() const { return model_; }
  /// Represents the inner shape exactly, if model() is ellipsoid_sum.
  const EllipsoidSum<double>& ellipsoid_sum() const { return ellipsoid_sum_; }
  /// The inner shape's two operands, or null. Extreme shapes have none, nor do shapes with a closed
  /// form or a faster model.
  const SumOfCores* operands() const { return operands_.get(); }
  /// True if each result of a cast at the shape must be proven, in double, before it is returned.
  bool is_extreme() const { return is_extreme_; }
  /// The inner shape's closed form, if it declares one. Extreme shapes have none.
  const exact::Form& form() const { return form_; }
  /// Hits are checked again if the component of their normal against the ray is less than this.
  /// Zero if the surface has neither corners nor flat faces.
  double uncertain_slope() const { return uncertain_slope_; }
  /// True if the ball's centre is the origin of the shape's own frame. The centre's position under
  /// a pose is then the translation of the pose.
  bool is_centred() const { return middle_.is_zero(); }
  /// Additional error bound of support points that are computed from coordinates larger than the
  /// shape; a length in the inner frame. Includes the rounding of maps that may have moved all
  /// points.
  double support_loss() const { return support_loss_; }
  bool has_large_loss() const {
    return support_loss_ > tolerance::small_loss<double> * ball_.radius;
  }
  /// True if rays can be cast at the shape in packets.
  bool has_packets() const {
    if (form_.kind != FormKind::none) return true;  // an extreme shape has none
    if (operands_) return false;                    // single casts take fewer steps
    return !is_extreme_ && !has_large_loss() && model_ != ModelKind::osculating_sums;
  }

  /// Bounds of the shape with all its transforms, under a pose.
  Bounds<double> bounds_of(const Affine<double>& pose) const;

  /// Placement of an instance. Each number of `to_inner` is rounded about once.
  struct Placement {
    TwoFoldVec3<double> centre;  ///< centre of the inner ball, in the frame of the pose
    Mat3<double> to_inner;       ///< map of directions
    bool is_rigid_identity;      ///< to_inner is the identity, or an ignored rotation of a ball
    /// The pose keeps lengths and there is no outer map: to_inner is the transposed linear part of
    /// the pose, and the centre is the inner ball's centre under the pose.
    bool is_plain = false;
    double loss =
        0.0;  ///< bound on the centre's displacement by rounding of the pose, in the inner frame
  };

  /// The ball's centre under a plain pose. SIMD lanes compute its rounded part in the same way.
  static TwoFoldVec3<double> plain_centre(const Affine<double>& pose,
                                          const Vec3<double>& ball_centre);
  static Vec3<double> rounded_plain_centre(const Affine<double>& pose,
                                           const Vec3<double>& ball_centre) {
    if (ball_centre.isZero(0)) return pose.translation;
    return pose.translation + times<double, double>(pose.linear, ball_centre);
  }
  /// Placement::loss of plain placements that are rotated.
  double plain_loss() const { return plain_loss_; }

  /// True if placements under poses that keep lengths are plain.
  bool is_plain() const { return is_plain_; }
  /// True for a ball around the inner frame's origin.
  bool is_round() const { return is_round_; }

  /// `pose` maps the frame of the shape to the outer one; it must be invertible.
  Placement placed(const Affine<double>& pose) const;

 private:
  /// Removes the outer transforms of the shape and adds them to `outer_` and `moved_`.
  void take_off();

  Nested original_;
  Shape inner_;
  TwoFoldMat3<double> outer_;  ///< the shape is outer_ * up * inner + moved_
  TwoFoldVec3<double> moved_;
  TwoFoldVec3<double> middle_;  ///< the ball's centre in the shape's frame
  double moved_loss_ = 0.0;     ///< bound on the centre's displacement by rounding of maps
  /// Power of two that scales a very large or small inner shape back to its size; its inverse.
  double up_ = 1.0, down_ = 1.0;
  Ball<double> ball_;
  Vec3<double> half_extents_;
  ModelKind model_;
  EllipsoidSum<double> ellipsoid_sum_;
  std::shared_ptr<const SumOfCores> operands_;
  double uncertain_slope_;
  double support_loss_;
  double plain_loss_ = 0.0;
  bool is_extreme_;
  bool is_plain_ = false, is_round_ = false;
  exact::Form form_;
};

}  // namespace minkray
