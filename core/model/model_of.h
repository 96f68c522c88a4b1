// SPDX-License-Identifier: MIT
// From a shape and the kind of model that suits it to the model. Only what casts includes this.
#pragma once

#include "core/model/axial_model.h"
#include "core/model/ellipsoid_sum_model.h"
#include "core/model/model_cast.h"
#include "core/model/parts_model.h"
#include "core/model/polytope_model.h"
#include "core/model/rounded_box_model.h"
#include "core/model/shape_definition.h"
#include "core/model/smooth_model.h"
#include "core/model/superellipsoid_model.h"
#include "core/model/translates_model.h"
#include "core/shape/declared.h"
#include "core/shape/shape.h"

namespace minkray {

namespace detail {

template <class S, class W>
using JetOf = decltype(std::declval<const S&>().jet(std::declval<const Vec3<W>&>()));

template <class S, class W>
inline constexpr bool is_axial =
    std::is_same_v<JetOf<S, W>, AxialBallJet<W>> || std::is_same_v<JetOf<S, W>, AxialDiskJet<W>>;
template <class S, class W>
inline constexpr bool is_ellipsoid = std::is_same_v<JetOf<S, W>, AxialEllipsoidJet<W>>;
template <class S, class W>
inline constexpr bool is_polytope = std::is_same_v<JetOf<S, W>, PointJet<W>>;

}  // namespace detail

/// Calls use(make_model), where make_model(s, r) makes the shape's model as seen from s along r.
template <class W, class Use>
auto with_model(const ShapeDefinition<Lane<W>>& definition, Use&& use) {
  using T = Lane<W>;
  const Shape<T>& shape = definition.inner_shape();
  const ModelKind model = definition.model();
  const Vec3<T>& centre = definition.inner_ball().centre;
  const T R = definition.inner_ball().radius;
  const auto simple = [&]<template <class, class> class Model, class S>(
                          const S& kind, std::type_identity<Model<W, S>>) {
    return use(
        [&](const Vec3<W>& s, const Vec3<W>& r) { return Model<W, S>(kind, centre, s, r, R); });
  };
  const auto polytope = [&]<class S>(const S& kind) {
    return simple(kind, std::type_identity<PolytopeModel<W, S>>());
  };
  const auto smooth = [&] { return simple(shape, std::type_identity<SmoothModel<W, Shape<T>>>()); };
  const auto ellipsoid_sum = [&] {
    return use([&](const Vec3<W>& s, const Vec3<W>& r) {
      return EllipsoidSumModel<W, Shape<T>>(shape, definition.ellipsoid_sum(), centre, s, r, R);
    });
  };
  const auto parts = [&] {
    return use(
        [&](const Vec3<W>& s, const Vec3<W>& r) { return PartsModel<W>(shape, centre, s, r, R); });
  };
  const auto rounded = [&]<class S>(const S& core, T radius) {
    return use([&, radius](const Vec3<W>& s, const Vec3<W>& r) {
      if constexpr (declared_by<S>.slabs)
        return RoundedBoxModel<W, S>(core, radius, centre, s, r, R);
      else
        return TranslatesModel<W, RoundedPolytope<W, S>>({core, radius}, centre, s, r, R);
    });
  };
  const auto translates = [&] {
    return use([&](const Vec3<W>& s, const Vec3<W>& r) {
      return TranslatesModel<W, JetTranslates<W, Shape<T>>>({shape}, centre, s, r, R);
    });
  };
  return std::visit(
      [&]<class S>(const S& kind) {
        if constexpr (detail::is_ellipsoid<S, W>) {
          return simple(kind, std::type_identity<EllipsoidModel<W, S>>());
        } else if constexpr (detail::is_axial<S, W>) {
          return simple(kind, std::type_identity<AxialModel<W, S>>());
        } else if constexpr (detail::is_polytope<S, W>) {
          return polytope(kind);
        } else if constexpr (std::is_same_v<S, Rounded<T>>) {
          if (model == ModelKind::points) return polytope(shape);
          if (model == ModelKind::smooth) return smooth();
          if (model == ModelKind::translates) return translates();
          if (model == ModelKind::ellipsoid_sum) return ellipsoid_sum();
          if (model == ModelKind::parts || model == ModelKind::osculated_parts) return parts();
          return std::visit(
              [&]<class Core>(const Core& core) {
                if constexpr (detail::is_polytope<Core, W>)
                  return rounded(core, kind.radius);
                else
                  return rounded(*kind.shape, kind.radius);
              },
              kind.shape->kind);
        } else {
          if (model == ModelKind::points) return polytope(shape);
          if constexpr (declared_by<S>.gauge)
            if (model == ModelKind::smooth)
              return simple(kind, std::type_identity<SuperellipsoidModel<W, S>>());
          if (model == ModelKind::ellipsoid_sum) return ellipsoid_sum();
          if (model == ModelKind::parts || model == ModelKind::osculated_parts) return parts();
          return model == ModelKind::translates ? translates() : smooth();
        }
      },
      shape.kind);
}

}  // namespace minkray
