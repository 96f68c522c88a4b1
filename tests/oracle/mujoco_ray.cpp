// SPDX-License-Identifier: MIT
#include "tests/oracle/mujoco_ray.h"

#include <mujoco/mujoco.h>

namespace minkray::testing {

std::optional<MujocoRay> MujocoRay::make(const Shape& shape) {
  MujocoRay ray;
  const auto has = [&](mjtGeom type, const Vec3<double>& size) {
    ray.type_ = type;
    ray.size_ = size;
    return ray;
  };
  if (const auto* s = std::get_if<Sphere>(&shape.kind))
    return has(mjGEOM_SPHERE, {s->radius, 0, 0});
  if (const auto* s = std::get_if<Capsule>(&shape.kind))
    return has(mjGEOM_CAPSULE, {s->radius, s->half_height, 0});
  if (const auto* s = std::get_if<Ellipsoid>(&shape.kind)) return has(mjGEOM_ELLIPSOID, s->radii);
  if (const auto* s = std::get_if<Cylinder>(&shape.kind))
    return has(mjGEOM_CYLINDER, {s->radius, s->half_height, 0});
  if (const auto* s = std::get_if<Box>(&shape.kind)) return has(mjGEOM_BOX, s->half_extents);
  return std::nullopt;
}

double MujocoRay::entry(const Ray<double>& ray) const {
  constexpr mjtNum at_origin[3] = {0, 0, 0};
  constexpr mjtNum not_turned[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const mjtNum t = mju_rayGeom(at_origin, not_turned, size_.data(), ray.origin.data(),
                               ray.direction.data(), type_);
  return t < 0 ? std::numeric_limits<double>::infinity() : t;
}

}  // namespace minkray::testing
