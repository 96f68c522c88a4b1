// SPDX-License-Identifier: MIT
#include "core/query/ray_near_ball.h"

#if defined(__x86_64__)

namespace minkray::detail {

[[gnu::target("fma")]] RayNearBall<double> ray_near_with_fma(const Vec3<double>& centre,
                                                             const Ray<double>& ray) {
  return ray_near_here<double>(centre, ray);
}

[[gnu::target("fma")]] RayNearBall<double> ray_near_with_fma(const TwoFoldVec3<double>& centre,
                                                             const Ray<double>& ray) {
  return ray_near_here<double>(centre, ray);
}

}  // namespace minkray::detail

#endif
