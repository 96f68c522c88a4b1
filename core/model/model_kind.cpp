// SPDX-License-Identifier: MIT
#include "core/model/model_kind.h"

#include "core/derived/ellipsoid_sum.h"
#include "core/support/declared.h"
#include "core/support/surface.h"

namespace minkray {
namespace {

ModelKind kind_of_surface(const Shape& shape) {
  switch (surface_of<double>(shape)) {
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

ModelKind model_kind_of(const Shape& shape) {
  return std::visit(
      [&]<class S>(const S& kind) {
        const ModelKind model = kind_of_surface(shape);
        if constexpr (declared_by<S>.gauge)
          if (model == ModelKind::smooth) return ModelKind::gauge;
        if constexpr (std::is_same_v<S, Rounded>)
          if (model != ModelKind::points && surface_of<double>(*kind.shape) == SurfaceKind::flat)
            return ModelKind::rounded_points;
        return model;
      },
      shape.kind);
}

}  // namespace minkray
