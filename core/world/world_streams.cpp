// SPDX-License-Identifier: MIT
// Any number of rays that go each their own way: the hierarchy finds pairs of ray and instance,
// lanes of floats sort most of them out, and what is left is cast at.
#include "core/bvh/stream.h"
#include "core/world/alike_screen.h"
#include "core/world/pair_screen.h"
#include "core/world/ray_block.h"
#include "core/world/world.h"

namespace minkray {
namespace {

/// Rays whose numbers stay in the cache while they are under way.
constexpr std::size_t rays_at_once = 1024;

/// Fewer are sooner answered one by one.
constexpr std::size_t least_stream = 4;

/// Walks the rays through the hierarchy, and looks and casts at what they meet.
template <class Screen>
void walk_pairs(const Bvh& bvh, std::span<SlabRay> slabs, Screen& screen, QueryCounts& counts) {
  const auto visit = [](void* context, const std::uint32_t* rays, const std::uint32_t* boxes,
                        std::size_t pairs) {
    static_cast<Screen*>(context)->take(rays, boxes, pairs);
  };
  counts.nodes += walk_stream(bvh, slabs, {visit, &screen});
  screen.finish();
}

}  // namespace

template <class T>
void World<T>::closest_of_pairs(std::span<const WorldRay<T>> rays, std::span<WorldHit<T>> hits,
                                QueryCounts& counts) const {
  RayLimits limits(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hits[i] = {};
    hits[i].cast.status = Status::miss;
    if (closer_half_space(rays[i], hits[i], counts))
      limits.lower(i, static_cast<double>(hits[i].cast.t()));
  }
  const auto keep = [&](std::uint32_t ray, std::uint32_t instance, T t, const auto& result) {
    WorldHit<T>& hit = hits[ray];
    if (!hit.yields_to(instance, t)) return;
    hit = {instance, instances_.turned(instance, result(), rays[ray].time)};
    limits.lower(ray, static_cast<double>(t));
  };
  const auto lower = [&](std::uint32_t ray, float t) {
    limits.lower(ray, static_cast<double>(t));
    limits.sure[ray] = 1;
    return true;
  };
  PairCaster<T, decltype(keep)> caster(instances_, options_, rays, counts, keep);
  PairScreen<T, decltype(caster), decltype(lower)> screen(instances_, rays, limits, caster, lower);
  walk_pairs(bvh_, limits.slabs, screen, counts);
  // Where what was sure to be met was not, a solver gave up: nothing is sure for this ray.
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (limits.sure[i] && !(hits[i].found() && hits[i].cast.t() <= T(limits.t[i])))
      hits[i] = closest_hit(rays[i], counts);
}

template <class T>
void World<T>::occluded_of_pairs(std::span<const WorldRay<T>> rays, std::span<std::uint8_t> met,
                                 QueryCounts& counts) const {
  RayLimits limits(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    met[i] = blocked_by_half_space(rays[i], counts) ? 1 : 0;
    if (met[i]) limits.end(i);
  }
  const auto end = [&](std::uint32_t ray) {
    met[ray] = 1;
    limits.end(ray);
  };
  const auto end_when_found = [&](std::uint32_t ray, std::uint32_t, T, const auto&) { end(ray); };
  // That it is met is all that is asked.
  const auto end_when_sure = [&](std::uint32_t ray, float) {
    end(ray);
    return false;
  };
  PairCaster<T, decltype(end_when_found)> caster(instances_, options_, rays, counts,
                                                 end_when_found);
  PairScreen<T, decltype(caster), decltype(end_when_sure)> screen(instances_, rays, limits, caster,
                                                                  end_when_sure);
  walk_pairs(bvh_, limits.slabs, screen, counts);
}

template <class T>
void World<T>::closest_of_alike(std::span<const WorldRay<T>> rays, std::span<WorldHit<T>> hits,
                                QueryCounts& counts) const {
  RayLimits limits(rays);
  for (WorldHit<T>& hit : hits) {
    hit.instance = no_instance;
    hit.cast = {};
    hit.cast.status = Status::miss;
  }
  const auto keep = [&](std::uint32_t ray, std::uint32_t instance, T t, const auto& result) {
    WorldHit<T>& hit = hits[ray];
    if (!hit.yields_to(instance, t)) return;
    hit = {instance, result()};
    limits.lower(ray, static_cast<double>(t));
  };
  PairCaster<T, decltype(keep)> caster(instances_, options_, rays, counts, keep);
  struct Left {
    std::uint32_t ray, instance;
    float first;
  };
  std::vector<Left> left;
  left.reserve(4 * rays.size());
  const bool have_own_maps = instances_.have_own_maps();
  const auto on_open = [&](std::uint32_t ray, std::uint32_t instance, float first, float last,
                           bool is_sure) {
    if (is_sure && last <= limits.t[ray]) {
      limits.lower(ray, static_cast<double>(last));
      limits.sure[ray] = 1;
    }
    left.push_back({ray, instance, first});
  };
  AlikeScreen<T, decltype(on_open)> screen(instances_, rays, limits, on_open);
  walk_pairs(bvh_, limits.slabs, screen, counts);
  // Gathered first, then fetched some ahead of the casts.
  std::size_t kept = 0;
  for (const Left& one : left) {
    left[kept] = one;
    kept += one.first <= limits.t[one.ray] ? 1 : 0;
  }
  left.resize(kept);
  constexpr std::size_t ahead = 16;
  const auto fetch = [&](std::size_t i) {
    if (i >= left.size()) return;
    instances_.prefetch_place(left[i].instance);
    if (have_own_maps) instances_.prefetch_own_map(left[i].instance);
  };
  for (std::size_t i = 0; i < ahead; ++i) fetch(i);
  for (std::size_t i = 0; i < left.size(); ++i) {
    fetch(i + ahead);
    caster.add(left[i].ray, left[i].instance);
  }
  caster.finish();
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (limits.sure[i] && !(hits[i].found() && hits[i].cast.t() <= T(limits.t[i])))
      hits[i] = closest_hit(rays[i], counts);
}

template <class T>
void World<T>::occluded_of_alike(std::span<const WorldRay<T>> rays, std::span<std::uint8_t> met,
                                 QueryCounts& counts) const {
  RayLimits limits(rays);
  for (std::uint8_t& one : met) one = 0;
  const auto end_when_found = [&](std::uint32_t ray, std::uint32_t, T, const auto&) {
    met[ray] = 1;
    limits.end(ray);
  };
  PairCaster<T, decltype(end_when_found)> caster(instances_, options_, rays, counts,
                                                 end_when_found);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> left;
  const auto on_open = [&](std::uint32_t ray, std::uint32_t instance, float, float,
                           bool is_sure) {
    if (is_sure) {
      met[ray] = 1;
      limits.end(ray);
    } else
      left.push_back({ray, instance});
  };
  AlikeScreen<T, decltype(on_open)> screen(instances_, rays, limits, on_open);
  walk_pairs(bvh_, limits.slabs, screen, counts);
  for (const auto& [ray, instance] : left)
    if (!met[ray]) caster.add(ray, instance);
  caster.finish();
}

namespace {

/// Whether rays run so nearly alike that they should walk together.
template <class T>
bool run_alike(std::span<const WorldRay<T>> rays, T widest) {
  constexpr T widest_turn = T(0.25);
  const Ray<T>& one = rays.front().ray;
  const T inverse = T(1) / one.direction.cwiseAbs().maxCoeff();
  for (const WorldRay<T>& other : rays.subspan(1)) {
    // Of about the same length, or it is not seen to run alike.
    const Vec3<T> turn = (other.ray.direction - one.direction) * inverse;
    const Vec3<T> moved = other.ray.origin - one.origin;
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(turn[axis]) <= widest_turn) || !(std::abs(moved[axis]) <= widest)) return false;
  }
  return true;
}

}  // namespace

template <class T>
void World<T>::closest_hits_of_all(std::span<const WorldRay<T>> rays, std::span<WorldHit<T>> hits,
                                   QueryCounts& counts) const {
  constexpr std::size_t group = most_rays_at_once;
  T widest = T(0);
  if (!bvh_.nodes.empty()) {
    Vec3<float> lower = bvh_.nodes[0].box(0).lower, upper = bvh_.nodes[0].box(0).upper;
    for (int child = 1; child < bvh_width; ++child)
      if (bvh_.nodes[0].children[child] != BvhNode::none) {
        lower = lower.cwiseMin(bvh_.nodes[0].box(child).lower);
        upper = upper.cwiseMax(bvh_.nodes[0].box(child).upper);
      }
    widest = T(0.02f * (upper - lower).maxCoeff());
  }
  std::size_t scattered = 0;  ///< so many before `first` wait for a stream
  const auto flush = [&](std::size_t first) {
    if (scattered == 0) return;
    closest_hits_in_stream(rays.subspan(first - scattered, scattered),
                           hits.subspan(first - scattered, scattered), counts);
    scattered = 0;
  };
  constexpr std::size_t block = rays_of_block;
  const auto block_of = [&](std::span<const WorldRay<T>> some, std::span<WorldHit<T>> to) {
    for (const WorldRay<T>& ray : some)
      if (ray.skip != no_instance) return false;
    BlockHits found;
    if (!closest_of_block(&some.front().ray, sizeof(WorldRay<T>), some.size(), found, counts))
      return false;
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (found.alone >> i & 1u) {
        to[i] = closest_hit(some[i], counts);
        continue;
      }
      to[i].instance = found.instance[i];
      if (found.found >> i & 1u) {
        if constexpr (std::is_same_v<T, double>)
          to[i].cast = found.casts[i / 4].result(static_cast<int>(i % 4));
      } else {
        to[i].cast = {};
        to[i].cast.status = Status::miss;
      }
    }
    return true;
  };
  for (std::size_t first = 0; first < rays.size(); first += group) {
    if (first % block == 0) {
      const std::size_t many = std::min(block, rays.size() - first);
      if (many > group / 2 &&
          block_of(rays.subspan(first, many), hits.subspan(first, many))) {
        flush(first);
        first += many > group ? group : 0;
        continue;
      }
    }
    const std::size_t count = std::min(group, rays.size() - first);
    if (count >= 4 && run_alike(rays.subspan(first, count), widest)) {
      flush(first);
      closest_hits(rays.subspan(first, count), hits.subspan(first, count), counts);
    } else
      scattered += count;
  }
  flush(rays.size());
}

template <class T>
void World<T>::closest_hits_in_stream(std::span<const WorldRay<T>> rays,
                                      std::span<WorldHit<T>> hits, QueryCounts& counts) const {
  if (!has_screen() || rays.size() < least_stream) {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest_hit(rays[i], counts);
    return;
  }
  for (std::size_t first = 0; first < rays.size(); first += rays_at_once) {
    const std::size_t count = std::min(rays_at_once, rays.size() - first);
    if (instances_.kind_of_all() != FormKind::none)
      closest_of_alike(rays.subspan(first, count), hits.subspan(first, count), counts);
    else
      closest_of_pairs(rays.subspan(first, count), hits.subspan(first, count), counts);
  }
}

template <class T>
void World<T>::occluded_in_stream(std::span<const WorldRay<T>> rays, std::span<std::uint8_t> met,
                                  QueryCounts& counts) const {
  if (!has_screen() || rays.size() < least_stream) {
    for (std::size_t i = 0; i < rays.size(); ++i) met[i] = occluded(rays[i], counts) ? 1 : 0;
    return;
  }
  for (std::size_t first = 0; first < rays.size(); first += rays_at_once) {
    const std::size_t count = std::min(rays_at_once, rays.size() - first);
    if (instances_.kind_of_all() != FormKind::none)
      occluded_of_alike(rays.subspan(first, count), met.subspan(first, count), counts);
    else
      occluded_of_pairs(rays.subspan(first, count), met.subspan(first, count), counts);
  }
}

template void World<float>::closest_hits_in_stream(std::span<const WorldRay<float>>,
                                                   std::span<WorldHit<float>>, QueryCounts&) const;
template void World<float>::closest_of_alike(std::span<const WorldRay<float>>,
                                             std::span<WorldHit<float>>, QueryCounts&) const;
template void World<float>::occluded_of_alike(std::span<const WorldRay<float>>, std::span<std::uint8_t>,
                                              QueryCounts&) const;
template void World<float>::closest_hits_of_all(std::span<const WorldRay<float>>,
                                                std::span<WorldHit<float>>, QueryCounts&) const;
template void World<float>::occluded_in_stream(std::span<const WorldRay<float>>,
                                               std::span<std::uint8_t>, QueryCounts&) const;
template void World<float>::closest_of_pairs(std::span<const WorldRay<float>>,
                                             std::span<WorldHit<float>>, QueryCounts&) const;
template void World<float>::occluded_of_pairs(std::span<const WorldRay<float>>,
                                              std::span<std::uint8_t>, QueryCounts&) const;
template void World<double>::closest_hits_in_stream(std::span<const WorldRay<double>>,
                                                    std::span<WorldHit<double>>,
                                                    QueryCounts&) const;
template void World<double>::closest_of_alike(std::span<const WorldRay<double>>,
                                             std::span<WorldHit<double>>, QueryCounts&) const;
template void World<double>::occluded_of_alike(std::span<const WorldRay<double>>, std::span<std::uint8_t>,
                                              QueryCounts&) const;
template void World<double>::closest_hits_of_all(std::span<const WorldRay<double>>,
                                                std::span<WorldHit<double>>, QueryCounts&) const;
template void World<double>::occluded_in_stream(std::span<const WorldRay<double>>,
                                                std::span<std::uint8_t>, QueryCounts&) const;
template void World<double>::closest_of_pairs(std::span<const WorldRay<double>>,
                                              std::span<WorldHit<double>>, QueryCounts&) const;
template void World<double>::occluded_of_pairs(std::span<const WorldRay<double>>,
                                               std::span<std::uint8_t>, QueryCounts&) const;

}  // namespace minkray
