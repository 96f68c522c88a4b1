// SPDX-License-Identifier: MIT
// Derivatives of ray casts with respect to the rays and to the bodies that they hit, with bounds of
// their errors. Header-only over minkray_c_pairs.h, whose comments specify the details.
#pragma once

// Example:
//   mk::ray_derivatives(scene, rays, hits, {by_ray, by_body, is_ridge});
#include "minkray/minkray.h"
#include "minkray/minkray_c_pairs.h"

namespace minkray {
inline namespace v0 {

/// Derivatives of a ray's t with respect to its origin and its direction.
struct RayTwist {
  Vec3 origin, direction;
};

/// Derivatives of t with respect to the rays, and to a twist of the hit objects; see
/// minkray_ray_derivatives. One item per ray; empty views are not filled.
struct RayDerivatives {
  View<RayTwist> by_ray = {};
  View<Twist> by_body = {};
  View<std::uint8_t> is_ridge = {};
  View<DerivativeError> error_ray = {};  ///< `velocity`: for the origin; `turn`: for the direction
  View<DerivativeError> error_body = {};
};

namespace detail {
/// Hits as the C function reads them, an array per field.
struct HitArrays {
  Room<double> t, t_lo, t_hi;
  Room<Vec3> points, normals;
  Room<std::uint32_t> objects;
  Room<std::uint8_t> status;
  Room<std::int32_t> parts;

  explicit HitArrays(View<const Hit> hits)
      : t(hits.size()),
        t_lo(hits.size()),
        t_hi(hits.size()),
        points(hits.size()),
        normals(hits.size()),
        objects(hits.size()),
        status(hits.size()),
        parts(hits.size()) {
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const Hit& one = hits.data()[i];
      t.items[i] = one.t;
      t_lo.items[i] = one.t_lo;
      t_hi.items[i] = one.t_hi;
      points.items[i] = one.point;
      normals.items[i] = one.normal;
      objects.items[i] = one.object;
      status.items[i] = static_cast<std::uint8_t>(one.status);
      parts.items[i] = one.part;
    }
  }
  minkray_hit_arrays plain() const {
    minkray_hit_arrays plain = {};
    plain.size = sizeof plain;
    plain.t = t.items;
    plain.t_lo = t_lo.items;
    plain.t_hi = t_hi.items;
    plain.points = &points.items->x;
    plain.normals = &normals.items->x;
    plain.objects = objects.items;
    plain.status = status.items;
    plain.parts = parts.items;
    return plain;
  }
};
}  // namespace detail

/// Derivatives of the hits that Scene::cast returned for the same rays.
inline void ray_derivatives(const Scene& scene, View<const Ray> rays, View<const Hit> hits,
                            const RayDerivatives& to, const Options& options = {}) {
  constexpr const char* function = "minkray::ray_derivatives";
  const std::size_t count = rays.size();
  detail::check_sizes(function, "hits", hits.size(), "rays", count);
  if (count == 0) return;
  minkray_ray_arrays from = {};
  from.size = sizeof from;
  from.origins = &rays.data()->origin.x;
  from.directions = &rays.data()->direction.x;
  from.origin_stride = from.direction_stride = sizeof(Ray);
  minkray_ray_derivatives plain = {};
  plain.size = sizeof plain;
  plain.jac_ray = detail::of_pairs<double>(function, "to.by_ray", to.by_ray, count);
  plain.jac_body = detail::of_pairs<double>(function, "to.by_body", to.by_body, count);
  plain.is_ridge = detail::of_pairs<std::uint8_t>(function, "to.is_ridge", to.is_ridge, count);
  plain.jac_error_ray = detail::of_pairs<double>(function, "to.error_ray", to.error_ray, count);
  plain.jac_error_body = detail::of_pairs<double>(function, "to.error_body", to.error_body, count);
  const detail::HitArrays copied(hits);
  const minkray_hit_arrays arrays = copied.plain();
  const minkray_options how = detail::plain(options);
  detail::check(minkray_scene_ray_derivatives(scene.handle(), &from, count, &arrays, &plain, &how));
}

}  // namespace v0
}  // namespace minkray
