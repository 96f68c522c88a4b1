// SPDX-License-Identifier: MIT
#include "bench/peers/others.h"
#include "tests/oracle/mujoco_ray.h"

namespace minkray::bench {

Peers mujoco(const Shape& shape) {
  Peers peers;
  if (const auto ray_at = testing::MujocoRay::make(shape))
    peers.push_back(single_rays<double>(
        "mujoco/double", [ray_at = *ray_at](const Ray<double>& ray) { return ray_at.entry(ray); },
        hit_at));
  return peers;
}

}  // namespace minkray::bench
