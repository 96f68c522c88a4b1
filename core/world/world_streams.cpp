// SPDX-License-Identifier: MIT
// Any number of rays that go each their own way: the hierarchy finds pairs of ray and instance,
// lanes of floats sort most of them out, and what is left is cast at.
#include "core/bvh/stream.h"
#include "core/world/pair_screen.h"
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
void World<T>::closest_hits_in_stream(std::span<const WorldRay<T>> rays,
                                      std::span<WorldHit<T>> hits, QueryCounts& counts) const {
  if (!has_screen() || rays.size() < least_stream) {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest_hit(rays[i], counts);
    return;
  }
  for (std::size_t first = 0; first < rays.size(); first += rays_at_once) {
    const std::size_t count = std::min(rays_at_once, rays.size() - first);
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
    occluded_of_pairs(rays.subspan(first, count), met.subspan(first, count), counts);
  }
}

template void World<float>::closest_hits_in_stream(std::span<const WorldRay<float>>,
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
template void World<double>::occluded_in_stream(std::span<const WorldRay<double>>,
                                                std::span<std::uint8_t>, QueryCounts&) const;
template void World<double>::closest_of_pairs(std::span<const WorldRay<double>>,
                                              std::span<WorldHit<double>>, QueryCounts&) const;
template void World<double>::occluded_of_pairs(std::span<const WorldRay<double>>,
                                               std::span<std::uint8_t>, QueryCounts&) const;

}  // namespace minkray
