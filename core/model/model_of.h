// SPDX-License-Identifier: MIT
// Makes the model of a shape, of the kind that suits it. Included only by sources of casts.
#pragma once

#include "core/model/ellipsoid_sum_model.h"
#include "core/model/gauge_model.h"
#include "core/model/model_cast.h"
#include "core/model/polytope_model.h"
#include "core/model/shape_definition.h"
#include "core/model/smooth_model.h"
#include "core/model/sums_model.h"
#include "core/model/translates_model.h"
#include "core/shape/shape.h"
#include "core/support/declared.h"

namespace minkray {

/// Calls use(make_model), where make_model(s, r) makes the shape's model as seen from s along r.
template <class W, class Use>
auto with_model(const ShapeDefinition& definition, Use&& use) {
  using T = Lane<W>;
  const Shape& shape = definition.inner_shape();
  const Vec3<T>& centre = definition.inner_ball().centre;
  const T R = definition.inner_ball().radius;
  const auto made_of = [&]<class Model>(std::type_identity<Model>, const auto&... what) {
    return use(
        [&](const Vec3<W>& s, const Vec3<W>& r) { return Model({what...}, centre, s, r, R); });
  };
  const auto polytope = [&]<class S>(const S& points) {
    return use([&](const Vec3<W>& s, const Vec3<W>& r) {
      return PolytopeModel<W, S>(points, centre, s, r, R);
    });
  };
  const auto rounded = [&]<class S>(const S& points, T radius) {
    return made_of(std::type_identity<TranslatesModel<W, RoundedPolytope<W, S>>>(), points, radius);
  };
  const auto smooth = [&] {
    return use([&](const Vec3<W>& s, const Vec3<W>& r) {
      return SmoothModel<W, Shape>(shape, centre, s, r, R);
    });
  };
  switch (definition.model()) {
    case ModelKind::points:
      return std::visit(
          [&]<class S>(const S& points) {
            if constexpr (declared_by<S>.facets || declared_by<S>.slabs)
              return polytope(points);  // facets are known
            else
              return polytope(shape);
          },
          shape.kind);
    case ModelKind::rounded_points: {
      const auto& [radius, core] = std::get<Rounded>(shape.kind);
      return std::visit(
          [&, r = radius, &any = *core]<class S>(const S& points) {
            if constexpr (declared_by<S>.facets)
              return rounded(points, r);
            else
              return rounded(any, r);
          },
          core->kind);
    }
    case ModelKind::translates:
      return made_of(std::type_identity<TranslatesModel<W, JetTranslates<W, Shape>>>(), shape);
    case ModelKind::gauge:
      return std::visit(
          [&]<class S>(const S& kind) {
            if constexpr (declared_by<S>.gauge)
              return use([&](const Vec3<W>& s, const Vec3<W>& r) {
                return GaugeModel<W, S>(kind, centre, s, r, R);
              });
            else
              return smooth();
          },
          shape.kind);
    case ModelKind::smooth:
      return smooth();
    case ModelKind::ellipsoid_sum:
      return use([&](const Vec3<W>& s, const Vec3<W>& r) {
        return EllipsoidSumModel<W, Shape>(shape, definition.ellipsoid_sum(), centre, s, r, R);
      });
    default:
      return use(
          [&](const Vec3<W>& s, const Vec3<W>& r) { return SumsModel<W>(shape, centre, s, r, R); });
  }
}

}  // namespace minkray
