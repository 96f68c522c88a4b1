// SPDX-License-Identifier: MIT
#include "core/model/model_kind.h"

#include "core/derived/ellipsoid_sum.h"
#include "core/support/declared.h"
#include "core/support/surface.h"

namespace minkray {
namespace {

template <class T>
ModelKind kind_of_surface(const Shape<T>& shape) {
  switch (surface_of<T>(shape)) {
    case SurfaceKind::flat:
      return ModelKind::points;
    case SurfaceKind::translates:
      return ModelKind::translates;
    case SurfaceKind::ellipsoids:
      return ModelKind::exact_sums;
    case SurfaceKind::smooth:
      if (is_ellipsoid_sum(shape)) return ModelKind::ellipsoid_sum;
      return has_exact_sums(shape) ? ModelKind::exact_sums : ModelKind::smooth;
    default:
      return has_exact_sums(shape) ? ModelKind::exact_sums : ModelKind::osculating_sums;
  }
}

}  // namespace

template <class T>
ModelKind model_kind_of(const Shape<T>& shape) {
  return std::visit(
      [&]<class S>(const S& kind) {
        const ModelKind model = kind_of_surface(shape);
        if constexpr (declared_by<S>.gauge)
          if (model == ModelKind::smooth) return ModelKind::gauge;
        if constexpr (std::is_same_v<S, Rounded<T>>)
          if (model != ModelKind::points && surface_of<T>(*kind.shape) == SurfaceKind::flat)
            return ModelKind::rounded_points;
        return model;
      },
      shape.kind);
}

template ModelKind model_kind_of(const Shape<float>&);
template ModelKind model_kind_of(const Shape<double>&);

}  // namespace minkray
