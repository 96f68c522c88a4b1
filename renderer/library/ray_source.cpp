// SPDX-License-Identifier: MIT
#include "renderer/library/ray_source.h"

#include <cmath>
#include <string>

#include "core/math/outward_sum.h"
#include "renderer/library/call.h"

namespace minkray {

RaySource::RaySource(const minkray_ray* rays, std::size_t count) : count_(count) {
  if (count == 0) return;
  require(rays, "rays");
  require_room(count, sizeof(minkray_ray), "count");
  origins_ = rays->origin;
  directions_ = rays->direction;
  t_max_ = &rays->t_max;
  origin_stride_ = direction_stride_ = t_max_stride_ = sizeof(minkray_ray);
  check();
}

RaySource::RaySource(const minkray_ray_arrays* rays, std::size_t count) : count_(count) {
  require(rays, "rays");
  if (rays->size < sizeof(minkray_ray_arrays))
    wrong_use("rays.size: must be sizeof(minkray_ray_arrays)");
  if (count == 0) return;
  require_room(count, sizeof(double), "count");
  require(rays->origins, "rays.origins");
  require(rays->directions, "rays.directions");
  origins_ = rays->origins;
  directions_ = rays->directions;
  t_max_ = rays->t_max;
  origin_stride_ = rays->origin_stride;
  direction_stride_ = rays->direction_stride;
  t_max_stride_ = rays->t_max_stride;
  check();
}

void RaySource::check() const {
  for (std::size_t i = 0; i < count_; ++i) {
    const Ray<double> ray = (*this)[i];
    // What is finite times zero is zero, anything else is not.
    const double zero = 0 * ((ray.origin.x() + 0 * ray.origin.y()) + 0 * ray.origin.z()) +
                        0 * ((ray.direction.x() + 0 * ray.direction.y()) + 0 * ray.direction.z());
    if (zero == 0 && ray.t_max >= 0) [[likely]]
      continue;
    if (ray.origin.allFinite() && ray.direction.allFinite() && ray.t_max >= 0) continue;
    const std::string place = "rays[" + std::to_string(i) + "].";
    if (!(ray.t_max >= 0))
      wrong_use(place + "t_max: must be >= 0 (got " + std::to_string(ray.t_max) + ")");
    const bool is_origin = !ray.origin.allFinite();
    const Vec3<double>& v = is_origin ? ray.origin : ray.direction;
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(v[k]))
        wrong_use(place + (is_origin ? "origin[" : "direction[") + std::to_string(k) +
                  "]: must be a finite number (got " + std::to_string(v[k]) + ")");
  }
}

minkray_hit plain_hit(const Ray<double>& ray, const WorldHit<double>& hit, bool gave_up) {
  minkray_hit plain = {};
  const CastResult<double>& cast = hit.cast;
  // What a solver gave up on may have been in front of anything.
  plain.status = gave_up ? MINKRAY_EXHAUSTED : static_cast<int>(cast.status);
  plain.object = hit.instance;
  plain.supports = cast.supports;
  if (!hit.found()) {
    plain.t = plain.t_lo = plain.t_hi = plain.t_base = std::numeric_limits<double>::infinity();
    for (double& x : plain.point) x = std::numeric_limits<double>::quiet_NaN();
    return plain;
  }
  plain.t = cast.t();
  plain.t_lo = sum_or_less(cast.t_base, cast.offset_lo);
  plain.t_hi = sum_or_more(cast.t_base, cast.offset_hi);
  plain.t_base = cast.t_base;
  plain.t_offset = cast.t_offset;
  for (int k = 0; k < 3; ++k) {
    plain.normal[k] = cast.normal[k];
    // In this order: from far away the first two nearly cancel.
    plain.point[k] =
        (ray.origin[k] + cast.t_base * ray.direction[k]) + cast.t_offset * ray.direction[k];
  }
  return plain;
}

void plain_hit(const Ray<double>& ray, const BlockHits& hits, std::size_t i, minkray_hit& to) {
  to.object = hits.instance[i];
  to.supports = to.reserved = 0;
  if (!(hits.found >> i & 1u)) {
    to.status = MINKRAY_MISS;
    to.t = to.t_lo = to.t_hi = to.t_base = std::numeric_limits<double>::infinity();
    to.t_offset = 0;
    for (double& x : to.point) x = std::numeric_limits<double>::quiet_NaN();
    for (double& x : to.normal) x = 0;
    return;
  }
  const CastPacket<double>& casts = hits.casts[i / 4];
  const std::size_t lane = i % 4;
  to.status = casts.hit >> lane & 1u ? MINKRAY_HIT : MINKRAY_INSIDE;
  const double base = casts.t_base[lane], offset = casts.t_offset[lane];
  to.t = base + offset;
  to.t_lo = sum_or_less(base, casts.offset_lo[lane]);
  to.t_hi = sum_or_more(base, casts.offset_hi[lane]);
  to.t_base = base;
  to.t_offset = offset;
  for (int k = 0; k < 3; ++k) {
    to.normal[k] = casts.normal[static_cast<std::size_t>(k)][lane];
    to.point[k] = (ray.origin[k] + base * ray.direction[k]) + offset * ray.direction[k];
  }
}

void store(const minkray_hit_arrays& arrays, std::size_t i, const Ray<double>& ray,
           const minkray_hit& hit) {
  if (arrays.t) arrays.t[i] = hit.t;
  if (arrays.t_lo) arrays.t_lo[i] = hit.t_lo;
  if (arrays.t_hi) arrays.t_hi[i] = hit.t_hi;
  if (arrays.distance) arrays.distance[i] = hit.t > 0 ? hit.t * ray.direction.norm() : hit.t;
  for (std::size_t k = 0; k < 3; ++k) {
    if (arrays.points) arrays.points[3 * i + k] = hit.point[k];
    if (arrays.normals) arrays.normals[3 * i + k] = hit.normal[k];
  }
  if (arrays.objects) arrays.objects[i] = hit.object;
  if (arrays.status) arrays.status[i] = static_cast<std::uint8_t>(hit.status);
  if (arrays.supports) arrays.supports[i] = hit.supports;
}

}  // namespace minkray
