// SPDX-License-Identifier: MIT
// Rays and results in the caller's layout: structs or arrays, contiguous or strided.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/world/world.h"
#include "renderer/library/handles/c_header.h"
#include "renderer/library/handles/call.h"

namespace minkray {

/// Rays that lie anywhere: strides are in bytes.
class RaySource {
 public:
  RaySource(const minkray_ray* rays, std::size_t count);
  RaySource(const minkray_ray_arrays* rays, std::size_t count);

  std::size_t size() const { return count_; }
  Ray<double> operator[](std::size_t i) const {
    const double* o = at(origins_, origin_stride_, i);
    const double* d = at(directions_, direction_stride_, i);
    Ray<double> ray{{o[0], o[1], o[2]}, {d[0], d[1], d[2]}};
    if (t_max_) ray.t_max = *at(t_max_, t_max_stride_, i);
    if (zero_is_endless_ && ray.t_max == 0) ray.t_max = std::numeric_limits<double>::infinity();
    return ray;
  }

  /// `count` rays from the i-th on, where they lie, or copied to `room` if coordinates lie apart.
  RaySpan part(std::size_t i, std::size_t count, std::vector<Ray<double>>& room) const {
    static_assert(sizeof(Ray<double>) == sizeof(minkray_ray));
    if (!has_zero_ends_ && origin_stride_ >= 0 && t_max_ == directions_ + 3 &&
        directions_ == origins_ + 3 && origin_stride_ == direction_stride_ &&
        origin_stride_ == t_max_stride_)
      return {reinterpret_cast<const Ray<double>*>(at(origins_, origin_stride_, i)),
              static_cast<std::size_t>(origin_stride_), count};
    room.resize(count);
    for (std::size_t k = 0; k < count; ++k) room[k] = (*this)[i + k];
    return {room.data(), sizeof(Ray<double>), count};
  }

 private:
  /// Throws CallError that names the first ray which is none.
  void check();
  [[noreturn]] void complain(std::size_t i) const;

  static const double* at(const double* first, std::ptrdiff_t stride, std::size_t i) {
    return reinterpret_cast<const double*>(reinterpret_cast<const char*>(first) +
                                           stride * static_cast<std::ptrdiff_t>(i));
  }

  std::size_t count_;
  const double *origins_ = nullptr, *directions_ = nullptr, *t_max_ = nullptr;
  std::ptrdiff_t origin_stride_ = 0, direction_stride_ = 0, t_max_stride_ = 0;
  bool zero_is_endless_ = false;  ///< of t_max, in structs
  bool has_zero_ends_ = false;    ///< of those, some
};

/// The one ray of a struct; throws CallError as RaySource does. Most calls have one.
inline Ray<double> ray_of(const minkray_ray* given) {
  require(given, "rays");
  const double* const o = given->origin;
  const double* const d = given->direction;
  const double zero = 0 * (o[0] + 0 * o[1] + 0 * o[2]) + 0 * (d[0] + 0 * d[1] + 0 * d[2]);
  const bool has_direction = d[0] != 0 || d[1] != 0 || d[2] != 0;
  if (zero != 0 || !has_direction || !(given->t_max > 0)) [[unlikely]]
    return RaySource(given, 1)[0];
  return {{o[0], o[1], o[2]}, {d[0], d[1], d[2]}, given->t_max};
}

/// The answer to one ray. `gave_up`: a solver did, at any object.
void plain_hit(const Ray<double>& ray, const WorldHit& hit, bool gave_up, minkray_hit& to);
inline minkray_hit plain_hit(const Ray<double>& ray, const WorldHit& hit, bool gave_up) {
  minkray_hit plain;
  plain_hit(ray, hit, gave_up, plain);
  return plain;
}

/// The i-th result of a block, which needs no cast of its own.
void plain_hit(const Ray<double>& ray, const BlockHits& hits, std::size_t i, minkray_hit& to);

/// Writes one answer into the arrays that there are.
void store(const minkray_hit_arrays& arrays, std::size_t i, const Ray<double>& ray,
           const minkray_hit& hit);

}  // namespace minkray
