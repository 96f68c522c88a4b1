// SPDX-License-Identifier: MIT
#include "core/model/shape_definition.h"

#include <optional>

#include "core/derived/as_rounded_box.h"
#include "core/derived/proportions.h"
#include "core/derived/recentred.h"
#include "core/derived/shape_bounds.h"
#include "core/derived/sum_of_cores.h"
#include "core/exact/ball.h"
#include "core/query/tolerances.h"

namespace minkray {
namespace {

/// Returns the closed form of an inner shape. A shape scaled to about unit size is a Transform;
/// uses the scaled form of the shape inside it.
exact::Form form_of(const Shape& inner, const Vec3<double>& ball_centre) {
  const auto* resized = std::get_if<Transform>(&inner.kind);
  if (!resized) return exact::form_of(inner, ball_centre, 1);
  return exact::form_of(*resized->shape, ball_centre, resized->map.affine().linear(0, 0));
}

/// Rounded hulls and triangles count as shapes with corners, since their radius may be tiny.
double uncertain_slope_of(ModelKind model, const exact::Form& form) {
  const bool has_faces = form.polytope != nullptr;
  if (model == ModelKind::smooth || model == ModelKind::gauge ||
      model == ModelKind::ellipsoid_sum || (model == ModelKind::rounded_points && !has_faces))
    return 0.0;
  return exact::is_round(form.kind) ? tolerance::uncertain_smooth_slope<double>
                                    : tolerance::uncertain_slope<double>;
}

/// A shape under a map, without a Transform object. Bounds are computed once per instance, and a
/// shared pointer to the shape would cost more than its support points.
struct Posed {
  const Shape& shape;
  AffineMap map;

  Vec3<double> support(const Vec3<double>& n) const {
    return map(shape.support(map.inner_direction(n)));
  }
};

/// The outer map under a pose. Usually at least one of the two is the identity.
TwoFoldMat3<double> linear_under(const Affine<double>& pose, const TwoFoldMat3<double>& outer) {
  if (outer.is_identity()) return pose.linear;
  return pose.linear == Mat3<double>::Identity() ? outer : TwoFoldMat3<double>(pose.linear) * outer;
}

}  // namespace

void ShapeDefinition::take_off() {
  for (bool simpler = true; simpler;) {
    std::optional<Shape> next = as_rounded_box(inner_);
    if (const auto* transform = std::get_if<Transform>(&inner_.kind)) {
      const Affine<double>& map = transform->map.affine();
      moved_ = moved_ + outer_ * TwoFoldVec3<double>(map.translation);
      moved_loss_ += loss_of_turning(outer_.high, map.translation.stableNorm());
      outer_ = outer_ * TwoFoldMat3<double>(map.linear);
      next = *transform->shape;
    }
    simpler = next.has_value();
    if (simpler) inner_ = *std::move(next);
  }
}

ShapeDefinition::ShapeDefinition(Shape shape) : original_(shape), inner_(std::move(shape)) {
  take_off();
  if (std::optional<Recentred> nearer = recentred(inner_)) {
    moved_ = moved_ + outer_ * nearer->moved;
    moved_loss_ += stretch_of(outer_.high) * nearer->loss +
                   loss_of_turning(outer_.high, nearer->moved.high.stableNorm());
    inner_ = std::move(nearer->shape);
    take_off();
  }
  Bounds<double> bounds = minkray::bounds_of(inner_);
  // Very small and very large shapes are scaled to about unit size, exactly, by a power of two.
  // Solvers multiply up to four lengths, and products must stay in the range of double.
  const double size = bounds.half_extents().maxCoeff();
  if (size > 0.0 && !(size >= 1.0 / tolerance::ordinary_size<double> &&
                      size <= tolerance::ordinary_size<double>)) {
    down_ = std::ldexp(1.0, -std::ilogb(size));
    up_ = std::ldexp(1.0, std::ilogb(size));
    inner_ = Transform{Nested(inner_), Affine<double>{Mat3<double>::Identity() * down_, {0, 0, 0}}};
    bounds = minkray::bounds_of(inner_);
  }
  ball_ = ball_around(bounds);
  middle_ = moved_ + outer_ * TwoFoldVec3<double>(ball_.centre * up_);
  if (!(ball_.radius > 0.0)) outer_ = {};       // linear maps do not change a point
  const bool is_point = !(ball_.radius > 0.0);  // only the position of a point matters
  support_loss_ = is_point ? 0.0
                           : tolerance::support_rounding<double> *
                                 std::max(largest_coordinate(inner_) - ball_.radius, 0.0);
  if (!is_point && moved_loss_ > 0.0)
    support_loss_ += stretch_of(accurate_inverse(outer_)) * down_ * moved_loss_;
  if (!is_point)
    plain_loss_ = tolerance::transposed_rounding<double> * ball_.radius +
                  tolerance::turned_rounding<double> * middle_.high.stableNorm();
  half_extents_ = bounds.reach_of_centre();
  model_ = model_kind_of(inner_);
  if (model_ == ModelKind::ellipsoid_sum)
    ellipsoid_sum_ = touching_sum<double>(inner_, Vec3<double>(0.0, 0.0, 1.0));
  is_extreme_ = has_extreme_proportions(inner_);
  if (!is_extreme_) form_ = form_of(inner_, ball_.centre);
  // The models of these two kinds take one or two steps.
  const bool has_fast_model = model_ == ModelKind::ellipsoid_sum || model_ == ModelKind::translates;
  if (!is_extreme_ && form_.kind == FormKind::none && !has_fast_model)
    if (std::optional<SumOfCores> operands = sum_of_cores(inner_))
      operands_ = std::make_shared<const SumOfCores>(*std::move(operands));
  is_plain_ = outer_.is_identity() && moved_.is_zero() && up_ == 1.0;
  is_round_ = form_.kind == exact::BallForm::kind && !form_.is_scaled && !form_.is_off_centre &&
              ball_.centre.isZero(0);
  uncertain_slope_ = uncertain_slope_of(model_, form_);
}

/// Computes bounds relative to the shape's middle first, so that rounding is relative to its size.
Bounds<double> ShapeDefinition::bounds_of(const Affine<double>& pose) const {
  const Mat3<double> linear = linear_under(pose, outer_).high * up_;
  const Bounds<double> about_middle = minkray::bounds_of(
      Posed{inner_, Affine<double>{linear, Vec3<double>(-(linear * ball_.centre))}});
  const Vec3<double> middle = image_of(pose, middle_).high;
  return {about_middle.lower + middle, about_middle.upper + middle};
}

TwoFoldVec3<double> ShapeDefinition::plain_centre(const Affine<double>& pose,
                                                  const Vec3<double>& ball_centre) {
  const Vec3<double> rounded = rounded_plain_centre(pose, ball_centre);
  if (ball_centre.isZero(0)) return TwoFoldVec3<double>(rounded);
  const TwoFoldVec3<double> exact = image_of(pose, TwoFoldVec3<double>(ball_centre));
  return {rounded, (exact - TwoFoldVec3<double>(rounded)).rounded()};
}

typename ShapeDefinition::Placement ShapeDefinition::placed(const Affine<double>& pose) const {
  if (is_plain_ && keeps_lengths(pose.linear)) {
    Placement plain;
    plain.is_plain = true;
    plain.centre = plain_centre(pose, ball_.centre);
    plain.to_inner = pose.linear.transpose();
    plain.is_rigid_identity = is_round_ || pose.linear == Mat3<double>::Identity();
    plain.loss = plain.is_rigid_identity ? 0.0 : plain_loss_;
    return plain;
  }
  const TwoFoldMat3<double> to_outer = linear_under(pose, outer_);
  Placement placement;
  placement.centre = image_of(pose, middle_);
  placement.to_inner = accurate_inverse(to_outer) * down_;
  placement.is_rigid_identity = to_outer.high * up_ == Mat3<double>::Identity();
  if (ball_.radius > 0.0 && !is_centred() && !placement.is_rigid_identity)
    placement.loss =
        stretch_of(placement.to_inner) * loss_of_turning(pose.linear, middle_.high.stableNorm());
  return placement;
}

}  // namespace minkray
