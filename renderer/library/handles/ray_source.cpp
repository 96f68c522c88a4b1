// SPDX-License-Identifier: MIT
#include "renderer/library/handles/ray_source.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>

#include "core/math/outward_sum.h"
#include "renderer/library/handles/call.h"

namespace minkray {

RaySource::RaySource(const minkray_ray* rays, std::size_t count) : count_(count) {
  if (count == 0) return;
  require(rays, "rays");
  require_room(count, sizeof(minkray_ray), "count");
  constexpr std::ptrdiff_t stride = sizeof(minkray_ray);
  origins_ = column("origin", rays->origin, nullptr, stride, 3);
  directions_ = column("direction", rays->direction, nullptr, stride, 3);
  t_max_ = column("t_max", &rays->t_max, nullptr, stride, 1);
  zero_is_endless_ = true;
  check();
}

RaySource::RaySource(const minkray_ray_arrays* rays, std::size_t count) : count_(count) {
  require(rays, "rays");
  if (rays->size < offsetof(minkray_ray_arrays, float_origins))
    wrong_use("rays.size: must be sizeof(minkray_ray_arrays)");
  if (count == 0) return;
  require_room(count, sizeof(double), "count");
  minkray_ray_arrays from = {};
  std::memcpy(&from, rays, std::min(rays->size, sizeof from));
  // In programs of older libraries a stride of zero means one row for all rays.
  is_zero_contiguous_ = rays->size >= sizeof from;
  origins_ = column("origins", from.origins, from.float_origins, from.origin_stride, 3);
  directions_ =
      column("directions", from.directions, from.float_directions, from.direction_stride, 3);
  t_max_ = column("t_max", from.t_max, from.float_t_max, from.t_max_stride, 1);
  require(origins_.first, "rays.origins");
  require(directions_.first, "rays.directions");
  check();
}

RaySource::Column RaySource::column(const char* name, const double* numbers, const float* floats,
                                    std::ptrdiff_t stride, std::size_t width) {
  if (numbers && floats)
    wrong_use(std::string("rays.") + name + ", rays.float_" + name + ": must not both be given");
  Column made{reinterpret_cast<const char*>(numbers), stride, floats != nullptr};
  if (floats) {
    made.first = reinterpret_cast<const char*>(floats);
    has_floats_ = true;
  }
  if (stride == 0 && is_zero_contiguous_)
    made.stride = static_cast<std::ptrdiff_t>(width * (floats ? sizeof(float) : sizeof(double)));
  return made;
}

void RaySource::check() {
  for (std::size_t i = 0; i < count_; ++i) {
    const Vec3<double> o = origins_.point(i), d = directions_.point(i);
    const double t_max = t_max_.first ? t_max_.number(i) : 1;
    // A finite number times zero is zero, any other is not.
    const double zero = 0 * ((o[0] + 0 * o[1]) + 0 * o[2]) + 0 * ((d[0] + 0 * d[1]) + 0 * d[2]);
    const bool has_direction = d[0] != 0 || d[1] != 0 || d[2] != 0;
    if (zero != 0 || !has_direction || !(t_max >= 0)) [[unlikely]]
      complain(i);
    has_zero_ends_ |= zero_is_endless_ && t_max == 0;
  }
}

void RaySource::complain(std::size_t i) const {
  const std::string place = "rays[" + std::to_string(i) + "].";
  const auto check_finite = [&](const char* member, const Vec3<double>& numbers) {
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(numbers[k]))
        wrong_use(place + member + "[" + std::to_string(k) + "]: must be a finite number (got " +
                  std::to_string(numbers[k]) + ")");
  };
  check_finite("origin", origins_.point(i));
  check_finite("direction", directions_.point(i));
  const double t_max = t_max_.first ? t_max_.number(i) : 0;
  if (!(t_max >= 0)) wrong_use(place + "t_max: must be >= 0 (got " + std::to_string(t_max) + ")");
  wrong_use(place + "direction: must not be zero (got [0, 0, 0])");
}

namespace {

/// Sets what a ray without a hit has.
inline void put_no_hit(minkray_hit& to) {
  to.t = to.t_lo = to.t_hi = to.t_base = std::numeric_limits<double>::infinity();
  to.t_offset = 0;
  for (double& x : to.point) x = std::numeric_limits<double>::quiet_NaN();
  for (double& x : to.normal) x = 0;
}

}  // namespace

void plain_hit(const Ray<double>& ray, const WorldHit& hit, bool gave_up, minkray_hit& to) {
  const CastResult<double>& cast = hit.cast;
  // A body whose solver did not converge may have been in front of anything.
  to.status = gave_up ? MINKRAY_EXHAUSTED : static_cast<int>(cast.status);
  to.object = hit.instance;
  to.supports = cast.supports;
  to.part = static_cast<std::int32_t>(hit.part);
  if (!hit.found()) return put_no_hit(to);
  to.t = cast.t();
  to.t_lo = sum_or_less(cast.t_base, cast.offset_lo);
  to.t_hi = sum_or_more(cast.t_base, cast.offset_hi);
  to.t_base = cast.t_base;
  to.t_offset = cast.t_offset;
  for (int k = 0; k < 3; ++k) {
    to.normal[k] = cast.normal[k];
    // In this order: from far away the first two nearly cancel.
    to.point[k] =
        (ray.origin[k] + cast.t_base * ray.direction[k]) + cast.t_offset * ray.direction[k];
  }
}

void plain_hit(const Ray<double>& ray, const BlockHits& hits, std::size_t i, minkray_hit& to) {
  to.object = hits.instance[i];
  to.supports = 0;
  to.part = -1;
  if (!(hits.found >> i & 1u)) {
    to.status = MINKRAY_MISS;
    return put_no_hit(to);
  }
  const CastPacket& casts = hits.casts[i / 4];
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
  if (arrays.size >= sizeof arrays && arrays.parts) arrays.parts[i] = hit.part;
}

}  // namespace minkray
