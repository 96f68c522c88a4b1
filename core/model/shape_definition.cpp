// SPDX-License-Identifier: MIT
#include "core/model/shape_definition.h"

#include <mutex>
#include <optional>

#include "core/derived/as_rounded_box.h"
#include "core/derived/convert.h"
#include "core/derived/proportions.h"
#include "core/derived/recentred.h"
#include "core/derived/shape_bounds.h"
#include "core/polytope/polytope.h"
#include "core/query/tolerances.h"
#include "core/support/declared.h"

namespace minkray {
namespace {

template <class T>
exact::Form rounded_polytope(const Rounded<T>& shape, const Vec3<double>& ball_centre,
                             double down) {
  return std::visit(
      [&]<class S>(const S& core) {
        if constexpr (declared_by<S>.facets)
          return exact::form_of(
              exact::Polytope::of(core.points, ball_centre, down, double(shape.radius) * down));
        else
          return exact::Form();
      },
      shape.shape->kind);
}

/// Declared form of an inner shape; for one brought to unit size, that of the shape within.
template <class T>
exact::Form exact_form_of(const Shape<T>& inner, const Vec3<double>& ball_centre) {
  const auto* resized = std::get_if<Transform<T>>(&inner.kind);
  const double down = resized ? double(resized->map.affine().linear(0, 0)) : 1;
  const Shape<T>& shape = resized ? *resized->shape : inner;
  return std::visit(
      [&](const auto& kind) {
        using S = std::remove_cvref_t<decltype(kind)>;
        if constexpr (std::is_same_v<S, Rounded<T>>)
          if (const exact::Form form = rounded_polytope(kind, ball_centre, down);
              form.kind != FormKind::none)
            return form;
        if constexpr (requires { kind.exact_form(); })
          return exact::form_of(kind.exact_form(), ball_centre, down);
        else if constexpr (declared_by<S>.facets)
          return exact::form_of(exact::Polytope::of(kind.points, ball_centre, down));
        else
          return exact::Form();
      },
      shape.kind);
}

/// Rounded hulls and triangles may be rounded by next to nothing.
template <class T>
T uncertain_slope_of(ModelKind model, FormKind form) {
  const bool has_faces = form == FormKind::polytope || form == FormKind::triangle;
  const bool is_round = form == FormKind::ball || form == FormKind::ellipsoid ||
                        form == FormKind::capsule || form == FormKind::tapered_capsule ||
                        form == FormKind::segment;
  if (model == ModelKind::smooth || model == ModelKind::gauge ||
      model == ModelKind::ellipsoid_sum || (model == ModelKind::rounded_points && !has_faces))
    return T(0);
  return is_round ? tolerance::uncertain_smooth_slope<T> : tolerance::uncertain_slope<T>;
}

/// A Transform that holds no shape: bounds are computed for as many poses as there are instances,
/// and sharing a shape among threads costs more than its supports.
template <class T>
struct Posed {
  const Shape<T>& shape;
  AffineMap<T> map;

  Vec3<T> support(const Vec3<T>& n) const { return map(shape.support(map.inner_direction(n))); }
};

/// The outer map under a pose; either is mostly none.
template <class T>
TwoFoldMat3<T> linear_under(const Affine<T>& pose, const TwoFoldMat3<T>& outer) {
  if (outer.is_identity()) return pose.linear;
  return pose.linear == Mat3<T>::Identity() ? outer : TwoFoldMat3<T>(pose.linear) * outer;
}

}  // namespace

/// Made once, by whichever thread is first.
template <class T>
struct ShapeDefinition<T>::InDouble {
  std::once_flag is_made;
  std::optional<ShapeDefinition<double>> definition;
};

template <class T>
const ShapeDefinition<double>* ShapeDefinition<T>::in_double() const {
  if (!in_double_) return nullptr;
  std::call_once(in_double_->is_made,
                 [&] { in_double_->definition.emplace(convert<double>(inner_)); });
  return &*in_double_->definition;
}

template <class T>
void ShapeDefinition<T>::take_off() {
  for (bool simpler = true; simpler;) {
    std::optional<Shape<T>> next = as_rounded_box(inner_);
    if (const auto* transform = std::get_if<Transform<T>>(&inner_.kind)) {
      const Affine<T>& map = transform->map.affine();
      moved_ = moved_ + outer_ * TwoFoldVec3<T>(map.translation);
      moved_loss_ += loss_of_turning(outer_.high, T(map.translation.stableNorm()));
      outer_ = outer_ * TwoFoldMat3<T>(map.linear);
      next = *transform->shape;
    }
    simpler = next.has_value();
    if (simpler) inner_ = *std::move(next);
  }
}

template <class T>
ShapeDefinition<T>::ShapeDefinition(Shape<T> shape) : original_(shape), inner_(std::move(shape)) {
  take_off();
  if (std::optional<Recentred<T>> nearer = recentred(inner_)) {
    moved_ = moved_ + outer_ * nearer->moved;
    moved_loss_ += stretch_of(outer_.high) * nearer->loss +
                   loss_of_turning(outer_.high, T(nearer->moved.high.stableNorm()));
    inner_ = std::move(nearer->shape);
    take_off();
  }
  Bounds<T> bounds = minkray::bounds_of<T>(inner_);
  // Very small and very large shapes are brought to about unit size by a power of two, which is
  // exact: solvers multiply up to four lengths, and must not leave the range of T.
  const T size = bounds.half_extents().maxCoeff();
  if (size > T(0) &&
      !(size >= T(1) / tolerance::ordinary_size<T> && size <= tolerance::ordinary_size<T>)) {
    down_ = std::ldexp(T(1), -std::ilogb(size));
    up_ = std::ldexp(T(1), std::ilogb(size));
    inner_ = Transform<T>{Nested<T>(inner_), Affine<T>{Mat3<T>::Identity() * down_, {0, 0, 0}}};
    bounds = minkray::bounds_of<T>(inner_);
  }
  ball_ = ball_around(bounds);
  middle_ = moved_ + outer_ * TwoFoldVec3<T>(ball_.centre * up_);
  if (!(ball_.radius > T(0))) outer_ = {};       // no map matters to a point
  const bool is_point = !(ball_.radius > T(0));  // a point is given by its place alone
  support_loss_ = is_point ? T(0)
                           : T(tolerance::support_rounding<T> *
                               std::max(T(largest_coordinate(inner_) - ball_.radius), T(0)));
  if (!is_point && moved_loss_ > T(0))
    support_loss_ += stretch_of(accurate_inverse(outer_)) * down_ * moved_loss_;
  if (!is_point)
    plain_loss_ = tolerance::transposed_rounding<T> * ball_.radius +
                  tolerance::turned_rounding<T> * T(middle_.high.stableNorm());
  half_extents_ = bounds.reach_of_centre();
  model_ = model_kind_of<T>(inner_);
  if (model_ == ModelKind::ellipsoid_sum)
    ellipsoid_sum_ = touching_sum<T>(inner_, Vec3<T>(T(0), T(0), T(1)));
  is_extreme_ = has_extreme_proportions(inner_);
  if constexpr (std::is_same_v<T, float>)
    is_lost_in_rounding_ = !is_extreme_ && minkray::is_lost_in_rounding(inner_);
  if (!is_extreme_) form_ = exact_form_of(inner_, ball_.centre.template cast<double>());
  is_plain_ = outer_.is_identity() && moved_.is_zero() && up_ == T(1);
  is_round_ = form_.kind == FormKind::ball && !form_.is_scaled && !form_.is_off_centre &&
              ball_.centre.isZero(T(0));
  uncertain_slope_ = uncertain_slope_of<T>(model_, form_.kind);
  if constexpr (std::is_same_v<T, float>) {
    const bool has_form = form_.kind != FormKind::none,
               is_polytope = form_.kind == FormKind::polytope;
    is_sliver_ = !has_form && !is_extreme_ && !is_lost_in_rounding_ && is_sliver(inner_);
    const bool is_plate = is_polytope && is_flat_but_for_rounding(inner_);
    is_asked_in_double_ = is_extreme_ || is_sliver_ || is_plate || (has_form && !is_polytope);
    if (is_asked_in_double_ || (uncertain_slope_ > 0 && !is_lost_in_rounding_))
      in_double_ = std::make_shared<InDouble>();
  }
  if (is_extreme_)
    in_long_double_ = std::make_shared<const Shape<long double>>(convert<long double>(inner_));
}

/// Takes bounds about the shape's middle first: these are rounded by the shape's size alone.
template <class T>
Bounds<T> ShapeDefinition<T>::bounds_of(const Affine<T>& pose) const {
  const Mat3<T> linear = linear_under(pose, outer_).high * up_;
  const Bounds<T> about_middle =
      minkray::bounds_of<T>(Posed<T>{inner_, Affine<T>{linear, Vec3<T>(-(linear * ball_.centre))}});
  const Vec3<T> middle = image_of(pose, middle_).high;
  return {about_middle.lower + middle, about_middle.upper + middle};
}

template <class T>
TwoFoldVec3<T> ShapeDefinition<T>::plain_centre(const Affine<T>& pose, const Vec3<T>& ball_centre) {
  const Vec3<T> rounded = rounded_plain_centre(pose, ball_centre);
  if (ball_centre.isZero(T(0))) return TwoFoldVec3<T>(rounded);
  const TwoFoldVec3<T> exact = image_of(pose, TwoFoldVec3<T>(ball_centre));
  return {rounded, (exact - TwoFoldVec3<T>(rounded)).rounded()};
}

template <class T>
typename ShapeDefinition<T>::Placement ShapeDefinition<T>::placed(const Affine<T>& pose) const {
  if (is_plain_ && keeps_lengths(pose.linear)) {
    Placement plain;
    plain.is_plain = true;
    plain.centre = plain_centre(pose, ball_.centre);
    plain.to_inner = pose.linear.transpose();
    plain.is_rigid_identity = is_round_ || pose.linear == Mat3<T>::Identity();
    plain.loss = plain.is_rigid_identity ? T(0) : plain_loss_;
    return plain;
  }
  const TwoFoldMat3<T> to_outer = linear_under(pose, outer_);
  Placement placement;
  placement.centre = image_of(pose, middle_);
  placement.to_inner = accurate_inverse(to_outer) * down_;
  placement.is_rigid_identity = to_outer.high * up_ == Mat3<T>::Identity();
  if (ball_.radius > T(0) && !is_centred() && !placement.is_rigid_identity)
    placement.loss =
        stretch_of(placement.to_inner) * loss_of_turning(pose.linear, T(middle_.high.stableNorm()));
  return placement;
}

template class ShapeDefinition<double>;
template class ShapeDefinition<float>;

}  // namespace minkray
