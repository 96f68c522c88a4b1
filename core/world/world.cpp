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
  counts.add_cast(result);
  return result;
}

/// A hierarchy whose boxes have moved is kept until rays are expected to visit so many times as
/// much as when it was built. Building 10,000 boxes anew takes as long as some ten thousand rays,
/// so that any picture pays for it; what is won by waiting is small, too.
constexpr double most_visits_after_refit = 1.5;

/// Packets are cast with the default options only.
template <class T>
bool are_default(const CastOptions<T>& options) {
  const CastOptions<T> standard;
  return options.solver == standard.solver && options.eps_tol == standard.eps_tol &&
         options.max_iterations == standard.max_iterations && options.v0 == standard.v0;
}

}  // namespace

template <class T>
World<T>::World(Instances<T> instances, const CastOptions<T>& options, BvhBuild build)
    : instances_(std::move(instances)),
      build_(build),
      options_(options),
      in_packets_(are_default(options)) {
  bvh_ = build_bvh(instances_.take_boxes(), build);
  if (has_screen()) instances_.make_lane_places();
  if (has_screen()) instances_.make_leaf_places(bvh_);
}

template <class T>
bool World<T>::closer_half_space(const WorldRay<T>& ray, WorldHit<T>& closest,
                                 QueryCounts& counts) const {
  bool found = false;
  for (const auto& [instance, at_rest, in_world] : instances_.half_spaces()) {
    if (ray.passes(instances_, instance)) continue;
    ++counts.casts;
    const CastResult<T> result =
        cast_ray(in_world, instances_.seen_by(instance, ray.ray, ray.time));
    counts.exhausted += result.status == Status::exhausted ? 1 : 0;
    if (!result.found() || !closest.yields_to(instance, result.t())) continue;
    closest = {instance, instances_.turned(instance, result, ray.time)};
    found = true;
  }
  return found;
}

template <class T>
bool World<T>::blocked_by_half_space(const WorldRay<T>& ray, QueryCounts& counts) const {
  WorldHit<T> any;
  return closer_half_space(ray, any, counts);
}

// Casts see the ray's own t_max, not that of the nearest hit so far: so their answers, and which of
// them is the nearest, do not depend on the order of the boxes.
template <class T>
void World<T>::closer_hit(const WorldRay<T>& ray, SlabRay& slabs, WorldHit<T>& closest,
                          QueryCounts& counts) const {
  if (closer_half_space(ray, closest, counts))
    slabs.numbers.t_max = slabs.limit(static_cast<double>(closest.cast.t()));
  auto on_instance = [&](std::uint32_t instance) {
    if (ray.passes(instances_, instance) || instances_.is_half_space(instance)) return false;
    const CastResult<T> result = counted_cast(
        instances_.at(instance), instances_.seen_by(instance, ray.ray, ray.time), options_, counts);
    if (!result.found() || !closest.yields_to(instance, result.t())) return false;
    closest = {instance, instances_.turned(instance, result, ray.time)};
    slabs.numbers.t_max = slabs.limit(static_cast<double>(result.t()));
    return false;
  };
  counts.nodes += traverse(bvh_, slabs, on_instance, prefetching());
}

template <class T>
bool World<T>::is_blocked(const WorldRay<T>& ray, const SlabRay& slabs, QueryCounts& counts) const {
  if (blocked_by_half_space(ray, counts)) return true;
  bool met = false;
  auto on_instance = [&](std::uint32_t instance) {
    if (ray.passes(instances_, instance) || instances_.is_half_space(instance)) return false;
    met = counted_cast(instances_.at(instance), instances_.seen_by(instance, ray.ray, ray.time),
                       options_, counts)
              .found();
    return met;
  };
  counts.nodes += traverse(bvh_, slabs, on_instance, prefetching());
  return met;
}

template <class T>
WorldHit<T> World<T>::closest_hit(const WorldRay<T>& ray, QueryCounts& counts) const {
  WorldHit<T> closest;
  closest.cast.status = Status::miss;
  SlabRay slabs(ray.ray);
  closer_hit(ray, slabs, closest, counts);
  return closest;
}

template <class T>
bool World<T>::occluded(const WorldRay<T>& ray, QueryCounts& counts) const {
  return is_blocked(ray, SlabRay(ray.ray), counts);
}

template <class T>
bool World<T>::has_screen() const {
  return in_packets_ && best_walk_set() == WalkSet::avx2;
}

template <class T>
void World<T>::pose_all(const std::function<Affine<T>(std::size_t)>& pose_of,
                        const std::function<Movement<T>(std::size_t)>& movement_of) {
  const auto visits = [&] {
    const VisitEstimate expected = expected_visits(bvh_);
    return expected.nodes + expected.leaves;
  };
  instances_.pose_all(pose_of, movement_of);
  const FirstTouchVector<Bounds<float>> boxes = instances_.take_boxes();
  if (visits_as_built_ == 0) visits_as_built_ = visits();
  if (has_screen()) instances_.make_lane_places();
  refit(bvh_, boxes);
  if (visits() > most_visits_after_refit * visits_as_built_) {
    bvh_ = build_bvh(boxes, build_);
    visits_as_built_ = visits();
  }
  if (has_screen()) instances_.make_leaf_places(bvh_);
}

template class World<float>;
template class World<double>;

}  // namespace minkray
