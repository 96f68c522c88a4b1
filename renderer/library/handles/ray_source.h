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
    Ray<double> ray{origins_.point(i), directions_.point(i)};
    if (t_max_.first) ray.t_max = t_max_.number(i);
    if (zero_is_endless_ && ray.t_max == 0) ray.t_max = std::numeric_limits<double>::infinity();
    return ray;
  }

  /// `count` rays from the i-th on, where they lie, or copied to `room` if coordinates lie apart.
  RaySpan part(std::size_t i, std::size_t count, std::vector<Ray<double>>& room) const {
    static_assert(sizeof(Ray<double>) == sizeof(minkray_ray));
    constexpr std::size_t size = 3 * sizeof(double);
    const std::ptrdiff_t stride = origins_.stride;
    if (!has_zero_ends_ && !has_floats_ && stride >= 0 && stride == directions_.stride &&
        stride == t_max_.stride && directions_.first == origins_.first + size &&
        t_max_.first == directions_.first + size)
      return {reinterpret_cast<const Ray<double>*>(origins_.at(i)),
              static_cast<std::size_t>(stride), count};
    room.resize(count);
    for (std::size_t k = 0; k < count; ++k) room[k] = (*this)[i + k];
    return {room.data(), sizeof(Ray<double>), count};
  }

 private:
  /// Numbers of type double or float.
  struct Column {
    const char* first = nullptr;
    std::ptrdiff_t stride = 0;
    bool is_float = false;

    const char* at(std::size_t i) const { return first + stride * static_cast<std::ptrdiff_t>(i); }
    template <class Number>
    const Number* row(std::size_t i) const {
      return reinterpret_cast<const Number*>(at(i));
    }
    double number(std::size_t i) const {
      return is_float ? double{*row<float>(i)} : *row<double>(i);
    }
    Vec3<double> point(std::size_t i) const {
      if (is_float) {
        const float* const p = row<float>(i);
        return {p[0], p[1], p[2]};
      }
      const double* const p = row<double>(i);
      return {p[0], p[1], p[2]};
    }
  };
  /// Column of one of the given arrays, of `width` numbers a ray. Throws CallError if both are
  /// given.
  Column column(const char* name, const double* numbers, const float* floats, std::ptrdiff_t stride,
                std::size_t width);

  /// Throws CallError that names the first ray which is none.
  void check();
  [[noreturn]] void complain(std::size_t i) const;

  std::size_t count_;
  Column origins_, directions_, t_max_;
  bool has_floats_ = false;
  bool is_zero_contiguous_ = false;  ///< of strides
  bool zero_is_endless_ = false;     ///< of t_max, in structs
  bool has_zero_ends_ = false;       ///< of those, some
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
