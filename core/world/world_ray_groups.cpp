// SPDX-License-Identifier: MIT
// Several rays at once: one walk through the hierarchy for all that run the same way, and packets
// of those that come to the same instance.
#include <array>

#include "core/bvh/stream.h"
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

/// Directions whose largest component is about 1.
bool diverge(const Vec3<double>& a, const Vec3<double>& b) {
  using std::abs;
  return abs(a.x() - b.x()) > widest_ray_group || abs(a.y() - b.y()) > widest_ray_group ||
         abs(a.z() - b.z()) > widest_ray_group;
}

/// on_group(group) for all rays that run along with others, on_single(i) for the rest. `slabs` gets
/// what each ray is tested with.
template <class T, class OnGroup, class OnSingle>
void in_groups(std::span<const WorldRay<T>> rays, std::array<SlabRay, capacity>& slabs,
               const OnGroup& on_group, const OnSingle& on_single) {
  if (rays.empty()) return;
  if (std::is_same_v<T, double> && best_walk_set() == WalkSet::avx2)
    make_slabs_avx2(reinterpret_cast<const char*>(&rays.data()->ray), sizeof(WorldRay<T>),
                    rays.size(), slabs.data());
  else
    for (std::size_t i = 0; i < rays.size(); ++i) slabs[i] = SlabRay(rays[i].ray);
  if (rays.size() == 1) return on_single(0);
  std::array<Vec3<double>, capacity> directions;
  for (std::size_t i = 0; i < rays.size(); ++i)
    directions[i] = rays[i].ray.direction.template cast<double>() *
                    (slabs[i].steps == 1 ? 1 : 1 / slabs[i].steps);
  Group group;
  for (RayGroupMask open = ~RayGroupMask(0) >> (capacity - rays.size()); open != 0;) {
    const auto first = static_cast<std::size_t>(next_of(open));
    group.rays.count = 0;
    group.add(slabs[first].numbers, first);
    for (RayGroupMask others = open; others != 0;) {
      const auto i = static_cast<std::size_t>(next_of(others));
      if (slabs[i].octant() != slabs[first].octant() || diverge(directions[i], directions[first]))
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
  // Lanes of floats look at each instance first; what is left and may come first is cast at.
  const auto on_group_of_alike = [&](Group& group) {
    ScreenBlock block;
    const auto index = [&](int lane) { return group.ray_of[static_cast<std::size_t>(lane)]; };
    const int lanes = (group.rays.count + screen_lanes - 1) / screen_lanes * screen_lanes;
    for (int lane = 0; lane < lanes; ++lane) {
      const int from = lane < group.rays.count ? lane : 0;
      const Ray<T>& ray = rays[index(from)].ray;
      for (int axis = 0; axis < 3; ++axis) {
        block.origin[axis][lane] = static_cast<double>(ray.origin[axis]);
        block.direction[axis][lane] = static_cast<double>(ray.direction[axis]);
      }
      block.t[lane] = detail::float_above(static_cast<double>(ray.t_max));
    }
    struct Left {
      float first;
      std::uint8_t lane;
      std::uint32_t instance;
    };
    constexpr std::size_t most_left = 1024;
    std::array<Left, most_left> left;
    std::size_t left_count = 0;
    RayGroupMask sure_rays = 0;
    const bool have_own_maps = instances_.have_own_maps();
    const FormKind kind = instances_.kind_of_all();
    const LanePlace<T>* const places = instances_.lane_places();
    const auto found = [&](int lane, std::uint32_t instance, T t, const auto& result) {
      WorldHit<T>& hit = hits[index(lane)];
      if (!hit.yields_to(instance, t)) return;
      hit = {instance, result()};
      const float above = detail::float_above(static_cast<double>(t));
      if (above < block.t[lane]) block.t[lane] = above;
    };
    const auto cast_left = [&] {
      for (std::size_t i = 0; i < left_count;) {
        const std::uint32_t instance = left[i].instance;
        RayGroupMask which = 0;
        for (; i < left_count && left[i].instance == instance; ++i)
          if (left[i].first <= block.t[left[i].lane]) which |= RayGroupMask(1) << left[i].lane;
        if (which == 0) continue;
        const auto ray_of = [&](int lane) { return rays[index(lane)].ray; };
        cast_all<T>(instances_.at(instance), which, ray_of, options_, in_packets_, counts,
                    [&](int lane, T t, const auto& result) { found(lane, instance, t, result); });
      }
      left_count = 0;
    };
    auto on_instance = [&](std::uint32_t instance, RayGroupMask meeting) {
      bool nearer = false, fetches = false;
      if (left_count + ray_group_capacity > most_left) cast_left();
      for (int first = 0; first < lanes; first += screen_lanes) {
        const std::uint32_t here = meeting >> first & 0xffu;
        if (here == 0) continue;
        Screened answers;
        const ScreenBits bits =
            screen_block_avx2<T>(kind, block, first, reinterpret_cast<const char*>(places + instance),
                                 instances_.screens(), answers);
        for (std::uint32_t open = bits.open & here; open != 0; open &= open - 1) {
          const int at = __builtin_ctz(open), lane = first + at;
          if (rays[index(lane)].skip == instance) continue;
          left[left_count++] = {answers.first[static_cast<std::size_t>(at)],
                                static_cast<std::uint8_t>(lane), instance};
          const float last = answers.last[static_cast<std::size_t>(at)];
          fetches = true;
          if (!(bits.sure >> at & 1u) || !(last < block.t[lane])) continue;
          block.t[lane] = last;
          sure_rays |= RayGroupMask(1) << lane;
          group.rays.set_t_max(lane, slabs[index(lane)].limit(static_cast<double>(last)));
          nearer = true;
        }
      }
      if (fetches) {
        instances_.prefetch_place(instance);
        if (have_own_maps) instances_.prefetch_own_map(instance);
      }
      if (nearer) group.rays.narrow();
      return false;
    };
    const auto ahead = [&](std::uint32_t instance) { __builtin_prefetch(places + instance); };
    const Walk walk = traverse(bvh_, group.rays, on_instance, ahead);
    counts.nodes += walk.visited;
    cast_left();
    for (int lane = 0; lane < group.rays.count; ++lane) {
      const WorldHit<T>& hit = hits[index(lane)];
      if (!walk.complete)
        on_single(index(lane));
      else if ((sure_rays >> lane & 1u) && !(hit.found() && hit.cast.t() <= T(block.t[lane])))
        hits[index(lane)] = closest_hit(rays[index(lane)], counts);
    }
  };
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hits[i].instance = no_instance;
    hits[i].cast = {};
    hits[i].cast.status = Status::miss;
  }
  // Of many planes, packets that walk over facets are sooner done than lanes of which half are idle.
  constexpr std::size_t most_planes_alike = 48;
  const auto has_few_planes = [&] {
    const auto& planes = instances_.screens()[0].planes;
    return !planes || planes->size() <= most_planes_alike * 5;
  };
  if (has_screen() && instances_.kind_of_all() != FormKind::none && has_few_planes())
    in_groups(rays, slabs, on_group_of_alike, on_single);
  else
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
