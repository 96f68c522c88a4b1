// SPDX-License-Identifier: MIT
#include "core/world/world.h"

#include <utility>

#include "core/bvh/traverse.h"
#include "core/parallel/parallel.h"

namespace minkray {
namespace {

/// Support points, and so the bounds made of them, are rounded; a solver's hits are as well.
/// Relative to the box's size and distance from the world's origin, in units of the machine
/// epsilon.
constexpr int bounds_padding = 32;

template <class T>
Bounds<T> padded(const Bounds<T>& bounds) {
  const T size = bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).maxCoeff();
  const T padding = T(bounds_padding) * tolerance::epsilon<T> * size;
  return {(bounds.lower.array() - padding).matrix(), (bounds.upper.array() + padding).matrix()};
}

template <class T>
CastResult<T> counted_cast(const PreparedShape<T>& shape, const Ray<T>& ray,
                           const CastOptions<T>& options, QueryCounts& counts) {
  const CastResult<T> result = cast_ray(shape, ray, options);
  ++counts.casts;
  counts.iterations += static_cast<std::uint64_t>(result.iterations);
  counts.supports += static_cast<std::uint64_t>(result.supports);
  counts.exhausted += result.status == Status::exhausted ? 1 : 0;
  return result;
}

}  // namespace

template <class T>
World<T>::World(std::vector<PreparedShape<T>> instances, const CastOptions<T>& options)
    : instances_(std::move(instances)), options_(options) {
  std::vector<Bounds<T>> boxes(instances_.size());
  for_parts(boxes.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) boxes[i] = padded(instances_[i].outer_bounds());
  });
  bvh_ = build_bvh<T>(boxes);
}

template <class T>
WorldHit<T> World<T>::closest_hit(const Ray<T>& ray, QueryCounts& counts,
                                  std::uint32_t skip) const {
  WorldHit<T> closest;
  closest.cast.status = Status::miss;
  counts.nodes += traverse(bvh_, ray, [&](std::uint32_t instance, T& t_max) {
    if (instance == skip) return false;
    const CastResult<T> result =
        counted_cast(instances_[instance], {ray.origin, ray.direction, t_max}, options_, counts);
    // Order matters: what is not clearly nearer is passed over.
    if (!result.found() || !(result.t() < t_max || !closest.found())) return false;
    closest = {instance, result};
    t_max = result.t();
    return result.status == Status::inside;
  });
  return closest;
}

template <class T>
bool World<T>::occluded(const Ray<T>& ray, QueryCounts& counts, std::uint32_t skip) const {
  bool met = false;
  counts.nodes += traverse(bvh_, ray, [&](std::uint32_t instance, T& t_max) {
    if (instance == skip) return false;
    met = counted_cast(instances_[instance], {ray.origin, ray.direction, t_max}, options_, counts)
              .found();
    return met;
  });
  return met;
}

template class World<float>;
template class World<double>;

}  // namespace minkray
