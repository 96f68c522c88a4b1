// SPDX-License-Identifier: MIT
#include "core/world/world.h"

#include <utility>

#include "core/bvh/traverse.h"

namespace minkray {
namespace {

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
World<T>::World(Instances<T> instances, const CastOptions<T>& options)
    : instances_(std::move(instances)), options_(options) {
  const std::vector<Bounds<float>> boxes = instances_.take_boxes();
  bvh_ = build_bvh<float>(boxes);
}

template <class T>
WorldHit<T> World<T>::closest_hit(const Ray<T>& ray, QueryCounts& counts,
                                  std::uint32_t skip) const {
  WorldHit<T> closest;
  closest.cast.status = Status::miss;
  counts.nodes += traverse(bvh_, ray, [&](std::uint32_t instance, T& t_max) {
    if (instance == skip) return false;
    const CastResult<T> result =
        counted_cast(instances_.at(instance), {ray.origin, ray.direction, t_max}, options_, counts);
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
    met =
        counted_cast(instances_.at(instance), {ray.origin, ray.direction, t_max}, options_, counts)
            .found();
    return met;
  });
  return met;
}

template class World<float>;
template class World<double>;

}  // namespace minkray
