// SPDX-License-Identifier: MIT
// Any number of rays that go each their own way: the hierarchy finds pairs of ray and instance, and
// as soon as there are enough of them at one definition these are cast in a packet, a ray and a
// pose in each lane.
#include "core/bvh/stream.h"
#include "core/cast/posed_packet.h"
#include "core/world/world.h"

namespace minkray {
namespace {

/// Rays whose numbers stay in the cache while they are under way.
constexpr std::size_t rays_at_once = 1024;

/// Pairs of ray and instance that wait for a packet: all of one definition, all turned or none.
template <class T>
class PairQueue {
 public:
  static constexpr int capacity = packet_lanes<T>;

  /// True when it is full.
  bool add(std::uint32_t ray, std::uint32_t instance) {
    const auto i = static_cast<std::size_t>(count_++);
    ray_[i] = ray;
    instance_[i] = instance;
    return count_ == capacity;
  }
  int size() const { return count_; }
  std::uint32_t ray(int i) const { return ray_[static_cast<std::size_t>(i)]; }
  std::uint32_t instance(int i) const { return instance_[static_cast<std::size_t>(i)]; }
  void clear() { count_ = 0; }

 private:
  int count_ = 0;
  std::array<std::uint32_t, static_cast<std::size_t>(capacity)> ray_, instance_;
};

/// Whether so many rays fill the queues, two for each shape that instances share: if not, rays are
/// faster one by one (docs/decisions/streams.md).
template <class T>
bool fill_queues(const Instances<T>& instances, std::size_t rays) {
  return 2 * instances.definitions() <= rays;
}

/// Casts at pairs, alone or in packets. on_found(ray, instance, t, result) is told of those that
/// meet; result() makes the CastResult.
template <class T, class OnFound>
class PairCaster {
 public:
  PairCaster(const Instances<T>& instances, const CastOptions<T>& options,
             std::span<const WorldRay<T>> rays, QueryCounts& counts, OnFound on_found)
      : instances_(instances),
        options_(options),
        rays_(rays),
        counts_(counts),
        on_found_(std::move(on_found)) {
    queues_.resize(2 * instances.definitions());
  }

  /// Pairs wait until the next ones come, and their instances' places with them.
  void take(const std::uint32_t* rays, const std::uint32_t* instances, std::size_t pairs) {
    sort_waiting();
    for (std::size_t i = 0; i < pairs; ++i) {
      if (rays_[rays[i]].skip == instances[i]) continue;
      instances_.prefetch_place(instances[i]);
      waiting_[waiting_count_++] = {rays[i], instances[i]};
    }
  }

  /// Casts at all that still wait.
  void finish() {
    sort_waiting();
    for (std::size_t i = 0; i < queues_.size(); ++i)
      if (queues_[i].size() != 0) cast_together(queues_[i], i % 2 == 1);
  }

 private:
  struct Pair {
    std::uint32_t ray, instance;
  };

  /// To the queues of their definitions.
  void sort_waiting() {
    for (std::size_t i = 0; i < waiting_count_; ++i) {
      const auto [ray, instance] = waiting_[i];
      if (instances_.is_half_space(instance)) continue;
      const std::uint32_t definition = instances_.definition_of(instance);
      if (instances_.definition(definition).form().kind == FormKind::none) {
        cast_alone(ray, instance);
        continue;
      }
      instances_.prefetch_map(instance);
      const bool is_turned = instances_.is_turned(instance);
      PairQueue<T>& queue = queues_[2 * definition + (is_turned ? 1 : 0)];
      if (queue.add(ray, instance)) cast_together(queue, is_turned);
    }
    waiting_count_ = 0;
  }

  Ray<T> seen(std::uint32_t ray, std::uint32_t instance) const {
    return instances_.seen_by(instance, rays_[ray].ray, rays_[ray].time);
  }

  void cast_alone(std::uint32_t ray, std::uint32_t instance) {
    const CastResult<T> result = cast_ray(instances_.at(instance), seen(ray, instance), options_);
    counts_.add_cast(result);
    if (result.found()) on_found_(ray, instance, result.t(), [&] { return result; });
  }

  void cast_together(PairQueue<T>& queue, bool are_turned) {
    RayPacket<T> packet;
    PosePacket<T> poses;
    poses.are_turned = are_turned;
    const int used = queue.size();
    for (int i = 0; i < queue.capacity; ++i) {
      const int pair = i < used ? i : 0;
      packet.set(i, seen(queue.ray(pair), queue.instance(pair)));
      poses.set(i, instances_.at(queue.instance(pair)));
    }
    CastPacket<T> answers;
    cast_packet(instances_.definition(instances_.definition_of(queue.instance(0))), poses, packet,
                (LaneBits(1) << used) - 1, answers);
    const LaneBits answered = answers.found() | answers.miss;
    for (int i = 0; i < used; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      const int supports = static_cast<int>(answers.supports[lane]);
      counts_.add_cast(supports, supports, answers.path[lane], !(answered >> i & 1));
      if (answers.found() >> i & 1)
        on_found_(queue.ray(i), queue.instance(i), answers.t(i), [&] { return answers.result(i); });
    }
    queue.clear();
  }

  const Instances<T>& instances_;
  const CastOptions<T>& options_;
  std::span<const WorldRay<T>> rays_;
  QueryCounts& counts_;
  OnFound on_found_;
  std::array<Pair, most_pairs_at_once> waiting_;
  std::size_t waiting_count_ = 0;
  std::vector<PairQueue<T>> queues_;  ///< two for each definition; none if there are too few rays
};

/// Walks the rays through the hierarchy and casts at what they meet.
template <class T, class Caster>
void walk_pairs(const Bvh& bvh, std::span<SlabRay> slabs, Caster& caster, QueryCounts& counts) {
  const auto visit = [](void* context, const std::uint32_t* rays, const std::uint32_t* boxes,
                        std::size_t pairs) {
    static_cast<Caster*>(context)->take(rays, boxes, pairs);
  };
  counts.nodes += walk_stream(bvh, slabs, {visit, &caster});
  caster.finish();
}

}  // namespace

template <class T>
void World<T>::closest_hits_in_stream(std::span<const WorldRay<T>> rays,
                                      std::span<WorldHit<T>> hits, QueryCounts& counts) const {
  if (!in_packets_ || !fill_queues(instances_, rays.size())) {
    for (std::size_t i = 0; i < rays.size(); ++i)
      hits[i] = closest_hit(rays[i].ray, counts, rays[i].skip, rays[i].time);
    return;
  }
  std::vector<SlabRay> slabs(std::min(rays.size(), rays_at_once));
  for (; !rays.empty(); rays = rays.subspan(slabs.size()), hits = hits.subspan(slabs.size())) {
    slabs.resize(std::min(rays.size(), rays_at_once));
    const auto keep = [&](std::uint32_t ray, std::uint32_t instance, T t, const auto& result) {
      WorldHit<T>& hit = hits[ray];
      if (!hit.yields_to(instance, t)) return;
      hit = {instance, instances_.turned(instance, result(), rays[ray].time)};
      slabs[ray].numbers.t_max = slabs[ray].limit(static_cast<double>(t));
    };
    for (std::size_t i = 0; i < slabs.size(); ++i) {
      slabs[i] = SlabRay(rays[i].ray);
      hits[i] = {};
      hits[i].cast.status = Status::miss;
      if (closer_half_space(rays[i], hits[i], counts))
        slabs[i].numbers.t_max = slabs[i].limit(static_cast<double>(hits[i].cast.t()));
    }
    PairCaster<T, decltype(keep)> caster(instances_, options_, rays.first(slabs.size()), counts,
                                         keep);
    walk_pairs<T>(bvh_, slabs, caster, counts);
  }
}

template <class T>
void World<T>::occluded_in_stream(std::span<const WorldRay<T>> rays, std::span<std::uint8_t> met,
                                  QueryCounts& counts) const {
  if (!in_packets_ || !fill_queues(instances_, rays.size())) {
    for (std::size_t i = 0; i < rays.size(); ++i)
      met[i] = occluded(rays[i].ray, counts, rays[i].skip, rays[i].time) ? 1 : 0;
    return;
  }
  std::vector<SlabRay> slabs(std::min(rays.size(), rays_at_once));
  for (; !rays.empty(); rays = rays.subspan(slabs.size()), met = met.subspan(slabs.size())) {
    slabs.resize(std::min(rays.size(), rays_at_once));
    const auto end = [&](std::uint32_t ray, std::uint32_t, T, const auto&) {
      met[ray] = 1;
      slabs[ray].numbers.t_max = -1;
    };
    for (std::size_t i = 0; i < slabs.size(); ++i) {
      slabs[i] = SlabRay(rays[i].ray);
      met[i] = blocked_by_half_space(rays[i], counts) ? 1 : 0;
      if (met[i]) slabs[i].numbers.t_max = -1;
    }
    PairCaster<T, decltype(end)> caster(instances_, options_, rays.first(slabs.size()), counts,
                                        end);
    walk_pairs<T>(bvh_, slabs, caster, counts);
  }
}

template void World<float>::closest_hits_in_stream(std::span<const WorldRay<float>>,
                                                   std::span<WorldHit<float>>, QueryCounts&) const;
template void World<double>::closest_hits_in_stream(std::span<const WorldRay<double>>,
                                                    std::span<WorldHit<double>>,
                                                    QueryCounts&) const;
template void World<float>::occluded_in_stream(std::span<const WorldRay<float>>,
                                               std::span<std::uint8_t>, QueryCounts&) const;
template void World<double>::occluded_in_stream(std::span<const WorldRay<double>>,
                                                std::span<std::uint8_t>, QueryCounts&) const;

}  // namespace minkray
