// SPDX-License-Identifier: MIT
// A shape with a pose, prepared for many casts. If the shape is another shape under one or more
// affine maps, solvers map the ray into that innermost shape's frame and cast there. This takes
// fewer and more accurate operations. The bounding ball is computed once.
#pragma once

#include <memory>

#include "core/model/shape_definition.h"
#include "core/query/bounds_cast.h"
#include "core/query/ray_near_ball.h"

namespace minkray {

/// A definition and a pose. "Inner" refers to the innermost shape and its frame, "outer" to the
/// frame in which rays are given.
class PreparedShape {
 public:
  using Definition = ShapeDefinition;

  /// `pose` maps the frame of `shape` to the outer frame; it must be invertible.
  explicit PreparedShape(Shape shape, const Affine<double>& pose = {})
      : PreparedShape(std::make_shared<const Definition>(std::move(shape)), pose) {}

  /// Shares the definition.
  PreparedShape(std::shared_ptr<const Definition> definition, const Affine<double>& pose)
      : definition_(std::move(definition)) {
    const auto placement = definition_->placed(pose);
    centre_ = placement.centre;
    to_inner_ = placement.to_inner;
    is_rigid_identity_ = placement.is_rigid_identity;
    loss_ = placement.loss;
  }

  /// Refers to the definition, which must outlive the prepared shape.
  PreparedShape(const Definition& definition, const typename Definition::Placement& placement)
      : PreparedShape(definition, placement.centre,
                      placement.is_rigid_identity ? nullptr : &placement.to_inner, placement.loss) {
  }

  /// Same, from the parts of a placement. Cheap enough for one call per cast, since references to
  /// the definition are not counted. `to_inner` is null for the identity. `loss` is
  /// ShapeDefinition::Placement::loss.
  PreparedShape(const Definition& definition, const TwoFoldVec3<double>& centre,
                const Mat3<double>* to_inner, double loss)
      : definition_(std::shared_ptr<const Definition>(), &definition),
        centre_(centre),
        is_rigid_identity_(!to_inner),
        loss_(loss) {
    if (to_inner) to_inner_ = *to_inner;
  }

  const Definition& definition() const { return *definition_; }
  /// Centre of the bounding ball in the outer frame: centre() is rounded to double, as closed forms
  /// use it; two_fold_centre() has twice the digits.
  const Vec3<double>& centre() const { return centre_.high; }
  const TwoFoldVec3<double>& two_fold_centre() const { return centre_; }
  /// Linear part of the map from the outer to the inner frame; null for the identity.
  const Mat3<double>* linear_to_inner() const { return is_rigid_identity_ ? nullptr : &to_inner_; }

  const Shape& inner_shape() const { return definition_->inner_shape(); }
  const Ball<double>& inner_ball() const { return definition_->inner_ball(); }
  /// Half extents of the inner shape's axis-aligned bounding box.
  const Vec3<double>& inner_half_extents() const { return definition_->inner_half_extents(); }

  /// Kind of model that the stage `model` uses for this shape.
  ModelKind model() const { return definition_->model(); }

  /// Maps the ray to the inner frame, relative to the ball's centre; W is double or a packet of it.
  template <class W>
  RayNearBall<W> to_inner(const Ray<W>& ray) const {
    RayNearBall<W> near = ray_near<W>(centre_, ray);
    map_to_inner(near);
    return near;  // not copied: reading an object just after its parts were written is slow
  }

  /// Same as to_inner, without losing digits if the ray's origin is far away.
  RayNearBall<double> to_inner_from_afar(const Ray<double>& ray) const {
    RayNearBall<double> near = ray_near_from_afar(centre_, ray);
    map_to_inner(near);
    return near;
  }

  /// Maps the ray's line to the inner frame, relative to the centre of the inner bounds.
  template <class W>
  [[gnu::always_inline]] LineFromCentre<W> line_to_inner(const Ray<W>& ray) const {
    using std::abs;
    const auto sizes = [](const Vec3<W>& v) { return Vec3<W>(abs(v.x()), abs(v.y()), abs(v.z())); };
    const auto line = [](const Vec3<W>& origin, const Vec3<W>& direction, const Vec3<W>& o,
                         const Vec3<W>& d) -> LineFromCentre<W> {
      return {origin, direction, W(o.x() + o.y() + o.z()), W(d.x() + d.y() + d.z())};
    };
    const Vec3<W> origin = detail::way_from<W>(centre_, ray.origin).rounded();
    const Vec3<W> o = sizes(origin), d = sizes(ray.direction);
    if (is_rigid_identity_) return line(origin, ray.direction, o, d);
    const Mat3<double> map_sizes = to_inner_.cwiseAbs();
    return line(times(to_inner_, origin), times(to_inner_, ray.direction), times(map_sizes, o),
                times(map_sizes, d));
  }

  /// Maps an inner normal to a unit normal in the outer frame.
  template <class W>
  Vec3<W> normal_to_outer(const Vec3<W>& normal) const {
    return is_rigid_identity_ ? normal : unit<W>(times<W, double>(to_inner_.transpose(), normal));
  }

  /// Maps an outer normal to an inner normal of any length. Slow; used for initial normals.
  Vec3<double> normal_to_inner(const Vec3<double>& normal) const {
    return is_rigid_identity_ ? normal : Vec3<double>(to_inner_.transpose().inverse() * normal);
  }

 private:
  template <class W>
  void map_to_inner(RayNearBall<W>& near) const {
    if (!is_rigid_identity_) near = near.mapped_with_loss(to_inner_, inner_ball().radius);
    near.loss += W(definition_->support_loss() + loss_);
    near.lambda_max += W(end_slack());
  }

  /// Length by which a ray's end may be extended, so that a ray that ends on the surface hits it in
  /// spite of rounding.
  double end_slack() const { return tolerance::end_slack<double> * inner_ball().radius; }

  std::shared_ptr<const Definition> definition_;
  TwoFoldVec3<double> centre_;
  Mat3<double> to_inner_;
  bool is_rigid_identity_;
  double loss_ = 0.0;
};

}  // namespace minkray
