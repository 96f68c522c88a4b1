// SPDX-License-Identifier: MIT
#include "core/solver/model_kind.h"

#include "core/shape/surface.h"
#include "core/solver/model_of.h"

namespace minkray {

template <class T>
ModelKind model_kind_of(const Shape<T>& shape) {
  return std::visit(
      [&]<class S>(const S& kind) {
        if constexpr (detail::is_axial<S, T> || detail::is_ellipsoid<S, T> ||
                      detail::is_polytope<S, T>) {
          return ModelKind::closed_form;
        } else {
          const SurfaceKind surface = surface_of<T>(shape);
          if constexpr (std::is_same_v<S, Rounded<T>>)
            if (surface != SurfaceKind::flat && surface_of<T>(*kind.shape) == SurfaceKind::flat)
              return ModelKind::rounded_points;
          return surface == SurfaceKind::flat         ? ModelKind::points
                 : surface == SurfaceKind::translates ? ModelKind::translates
                 : surface == SurfaceKind::smooth     ? ModelKind::smooth
                                                      : ModelKind::mixed;
        }
      },
      shape.kind);
}

template ModelKind model_kind_of(const Shape<float>&);
template ModelKind model_kind_of(const Shape<double>&);

}  // namespace minkray
