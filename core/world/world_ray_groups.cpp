// SPDX-License-Identifier: MIT
// Several rays at once: one walk through the hierarchy for all that run the same way, and packets
// of those that come to the same instance.
#include <array>

#include "core/bvh/traverse.h"
#include "core/cast/packet_cast.h"
#include "core/world/world.h"

namespace minkray {
namespace {

constexpr auto capacity = static_cast<std::size_t>(ray_group_capacity);

/// Rays of one octant out of several.
struct Group {
  RayGroup rays;
  std::array<std::uint8_t, capacity> ray_of;  ///< by the group's ray: which of all rays

  void add(const SlabNumbers& numbers, std::size_t ray) {
    ray_of[static_cast<std::size_t>(rays.count)] = static_cast<std::uint8_t>(ray);
    rays.add(numbers);
  }
};

/// Takes the lowest of the rays out.
int next_of(RayGroupMask& rays) {
  const int ray = std::countr_zero(rays);
  rays &= rays - 1;
  return ray;
}

/// Directions further apart than this (their largest component is about 1) gain nothing together.
constexpr double widest_ray_group = 0.25;

/// Leaves that a group may test in vain, for each of its rays: about as many as cost what a ray
/// costs alone. By measurement, see docs/decisions/rays-together.md.
constexpr int patience_a_ray = 2;

template <class T>
bool diverges(const Ray<T>& a, const SlabRay& slabs_a, const Ray<T>& b, const SlabRay& slabs_b) {
  const Vec3<double> difference = a.direction.template cast<double>() * (1 / slabs_a.steps) -
                                  b.direction.template cast<double>() * (1 / slabs_b.steps);
  return difference.cwiseAbs().maxCoeff() > widest_ray_group;
}

/// on_group(group) for all rays that run along with others, on_single(i) for the rest. `slabs` gets
/// what each ray is tested with.
template <class T, class OnGroup, class OnSingle>
void in_groups(std::span<const WorldRay<T>> rays, std::array<SlabRay, capacity>& slabs,
               const OnGroup& on_group, const OnSingle& on_single) {
  if (rays.empty()) return;
  for (std::size_t i = 0; i < rays.size(); ++i) slabs[i] = SlabRay(rays[i].ray);
  if (rays.size() == 1) return on_single(0);
  Group group;
  for (RayGroupMask open = ~RayGroupMask(0) >> (capacity - rays.size()); open != 0;) {
    const auto first = static_cast<std::size_t>(next_of(open));
    group.rays.count = 0;
    group.add(slabs[first].numbers, first);
    for (RayGroupMask others = open; others != 0;) {
      const auto i = static_cast<std::size_t>(next_of(others));
      if (slabs[i].octant() != slabs[first].octant() ||
          diverges(rays[i].ray, slabs[i], rays[first].ray, slabs[first]))
        continue;
      group.add(slabs[i].numbers, i);
      open &= ~(RayGroupMask(1) << i);
    }
    if (group.rays.count == 1) {
      on_single(first);
      continue;
    }
    group.rays.fill_up();
    group.rays.patience = patience_a_ray * group.rays.count;
    on_group(group);
  }
}

/// Casts the rays (of those that `ray_of` numbers, the set `which`) at one shape, in packets as
/// full as can be, and what is left over alone. on_found(lane, t, result) for those that meet it;
/// result() makes the CastResult.
template <class T, class RayOf, class OnFound>
void cast_all(const PreparedShape<T>& shape, RayGroupMask which, const RayOf& ray_of,
              const CastOptions<T>& options, bool in_packets, QueryCounts& counts,
              const OnFound& on_found) {
  const bool has_packets = in_packets && shape.definition().has_packets();
  while (which != 0) {
    if (!has_packets || std::has_single_bit(which)) {
      const int lane = next_of(which);
      const CastResult<T> result = cast_ray(shape, ray_of(lane), options);
      counts.add_cast(result);
      if (result.found()) on_found(lane, result.t(), [&] { return result; });
      continue;
    }
    std::array<int, packet_lanes<T>> lane_of;
    int used = 0;
    RayPacket<T> packet;
    for (; used < packet_lanes<T> && which != 0; ++used) {
      const int lane = next_of(which);
      lane_of[static_cast<std::size_t>(used)] = lane;
      packet.set(used, ray_of(lane));
    }
    for (int i = used; i < packet_lanes<T>; ++i) packet.set(i, ray_of(lane_of[0]));
    CastPacket<T> answers;
    cast_packet(shape, packet, (LaneBits(1) << used) - 1, answers);
    const LaneBits answered = answers.found() | answers.miss;
    for (int i = 0; i < used; ++i) {
      const auto used_lane = static_cast<std::size_t>(i);
      const int supports = static_cast<int>(answers.supports[used_lane]);
      counts.add_cast(supports, supports, answers.path[used_lane], !(answered >> i & 1));
      if (answers.found() >> i & 1)
        on_found(lane_of[static_cast<std::size_t>(i)], answers.t(i),
                 [&] { return answers.result(i); });
    }
  }
}

/// The group's rays of the set `which` that do not pass the instance.
template <class T>
RayGroupMask without_passing(RayGroupMask which, const Instances<T>& instances,
                             std::uint32_t instance, std::span<const WorldRay<T>> rays,
                             const Group& group) {
  RayGroupMask rest = which;
  for (RayGroupMask left = which; left != 0;) {
    const int lane = next_of(left);
    if (rays[group.ray_of[static_cast<std::size_t>(lane)]].passes(instances, instance))
      rest &= ~(RayGroupMask(1) << lane);
  }
  return rest;
}

}  // namespace

template <class T>
void World<T>::closest_hits(std::span<const WorldRay<T>> rays, std::span<WorldHit<T>> hits,
                            QueryCounts& counts) const {
  std::array<SlabRay, capacity> slabs;
  const auto on_single = [&](std::size_t i) { closer_hit(rays[i], slabs[i], hits[i], counts); };
  const auto on_group = [&](Group& group) {
    const auto index = [&](int lane) { return group.ray_of[static_cast<std::size_t>(lane)]; };
    if (!instances_.half_spaces().empty()) {
      for (int lane = 0; lane < group.rays.count; ++lane) {
        WorldHit<T>& hit = hits[index(lane)];
        if (!closer_half_space(rays[index(lane)], hit, counts)) continue;
        SlabRay& slab = slabs[index(lane)];
        slab.numbers.t_max = slab.limit(static_cast<double>(hit.cast.t()));
        group.rays.set_t_max(lane, slab.numbers.t_max);
      }
      group.rays.narrow();
    }
    auto on_instance = [&](std::uint32_t instance, RayGroupMask meeting) {
      if (instances_.is_half_space(instance)) return false;
      const auto ray_of = [&](int lane) {
        const WorldRay<T>& asked = rays[index(lane)];
        return instances_.seen_by(instance, asked.ray, asked.time);
      };
      meeting = without_passing(meeting, instances_, instance, rays, group);
      bool nearer = false;
      cast_all<T>(instances_.at(instance), meeting, ray_of, options_, in_packets_, counts,
                  [&](int lane, T t, const auto& result) {
                    WorldHit<T>& hit = hits[index(lane)];
                    if (!hit.yields_to(instance, t)) return;
                    hit = {instance, instances_.turned(instance, result(), rays[index(lane)].time)};
                    SlabRay& slab = slabs[index(lane)];
                    slab.numbers.t_max = slab.limit(static_cast<double>(t));
                    group.rays.set_t_max(lane, slab.numbers.t_max);
                    nearer = true;
                  });
      if (nearer) group.rays.narrow();
      return false;
    };
    const Walk walk = traverse(bvh_, group.rays, on_instance, prefetching());
    counts.nodes += walk.visited;
    if (walk.complete) return;
    for (int lane = 0; lane < group.rays.count; ++lane) on_single(index(lane));
  };
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hits[i] = {};
    hits[i].cast.status = Status::miss;
  }
  in_groups(rays, slabs, on_group, on_single);
}

template <class T>
RayGroupMask World<T>::occluded(std::span<const WorldRay<T>> rays, QueryCounts& counts) const {
  RayGroupMask met = 0;
  std::array<SlabRay, capacity> slabs;
  const auto on_single = [&](std::size_t i) {
    if (is_blocked(rays[i], slabs[i], counts)) met |= RayGroupMask(1) << i;
  };
  const auto on_group = [&](Group& group) {
    const auto index = [&](int lane) { return group.ray_of[static_cast<std::size_t>(lane)]; };
    int open = group.rays.count;
    if (!instances_.half_spaces().empty()) {
      for (int lane = 0; lane < group.rays.count; ++lane) {
        if (!blocked_by_half_space(rays[index(lane)], counts)) continue;
        met |= RayGroupMask(1) << index(lane);
        group.rays.set_t_max(lane, -1);
        --open;
      }
      if (open == 0) return;
      group.rays.narrow();
    }
    auto on_instance = [&](std::uint32_t instance, RayGroupMask meeting) {
      if (instances_.is_half_space(instance)) return false;
      const auto ray_of = [&](int lane) {
        const WorldRay<T>& asked = rays[index(lane)];
        return instances_.seen_by(instance, asked.ray, asked.time);
      };
      meeting = without_passing(meeting, instances_, instance, rays, group);
      const int before = open;
      cast_all<T>(instances_.at(instance), meeting, ray_of, options_, in_packets_, counts,
                  [&](int lane, T, const auto&) {
                    met |= RayGroupMask(1) << index(lane);
                    group.rays.set_t_max(lane, -1);
                    --open;
                  });
      if (open < before) group.rays.narrow();
      return open == 0;
    };
    const Walk walk = traverse(bvh_, group.rays, on_instance, prefetching());
    counts.nodes += walk.visited;
    if (walk.complete) return;
    for (int lane = 0; lane < group.rays.count; ++lane)
      if (!(met >> index(lane) & 1)) on_single(index(lane));
  };
  in_groups(rays, slabs, on_group, on_single);
  return met;
}

template void World<float>::closest_hits(std::span<const WorldRay<float>>,
                                         std::span<WorldHit<float>>, QueryCounts&) const;
template void World<double>::closest_hits(std::span<const WorldRay<double>>,
                                          std::span<WorldHit<double>>, QueryCounts&) const;
template RayGroupMask World<float>::occluded(std::span<const WorldRay<float>>, QueryCounts&) const;
template RayGroupMask World<double>::occluded(std::span<const WorldRay<double>>,
                                              QueryCounts&) const;

}  // namespace minkray
