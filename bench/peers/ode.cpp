// SPDX-License-Identifier: MIT
#include "bench/peers/others.h"
#include "tests/oracle/ode_ray.h"

namespace minkray::bench {

Peers ode(const Shape& shape) {
  Peers peers;
  if (const std::shared_ptr<testing::OdeRay> ray_at = testing::OdeRay::make(shape))
    peers.push_back(single_rays<double>(
        "ode/double", [ray_at](const Ray<double>& ray) { return ray_at->entry(ray); }, hit_at));
  return peers;
}

}  // namespace minkray::bench
