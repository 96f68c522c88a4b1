// SPDX-License-Identifier: MIT
// Casts at pairs of a ray and an instance: as soon as there are enough of them at one definition
// they are cast in a packet, a ray and a pose in each lane.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/cast/posed_packet.h"
#include "core/world/world.h"

namespace minkray {

/// Pairs of ray and instance that wait until there are `lanes` of them.
template <int lanes>
class PairQueue {
 public:
  /// True when it is full.
  bool add(std::uint32_t ray, std::uint32_t instance) {
    const auto i = static_cast<std::size_t>(count_++);
    ray_[i] = ray;
    instance_[i] = instance;
    return count_ == lanes;
  }
  int size() const { return count_; }
  std::uint32_t ray(int i) const { return ray_[static_cast<std::size_t>(i)]; }
  std::uint32_t instance(int i) const { return instance_[static_cast<std::size_t>(i)]; }
  void clear() { count_ = 0; }

 private:
  int count_ = 0;
  std::array<std::uint32_t, static_cast<std::size_t>(lanes)> ray_, instance_;
};

/// Casts at pairs, alone or in packets. on_found(ray, instance, t, result) is told of those that
/// meet; result() makes the CastResult.
template <class T, class OnFound>
class PairCaster {
 public:
  /// Definitions have queues where there are rays enough to fill them, two for each
  /// (docs/decisions/streams.md); where not, they are cast at one by one.
  PairCaster(const Instances<T>& instances, const CastOptions<T>& options,
             std::span<const WorldRay<T>> rays, QueryCounts& counts, OnFound on_found)
      : instances_(instances),
        options_(options),
        rays_(rays),
        counts_(counts),
        on_found_(std::move(on_found)) {
    if (2 * instances.definitions() <= rays.size()) queues_.resize(2 * instances.definitions());
  }

  /// The instance is no half-space.
  void add(std::uint32_t ray, std::uint32_t instance) {
    const std::uint32_t definition = instances_.definition_of(instance);
    if (queues_.empty() || instances_.definition(definition).form().kind == FormKind::none)
      return cast_alone(ray, instance);
    const bool is_turned = instances_.is_turned(instance);
    Queue& queue = queues_[2 * definition + (is_turned ? 1 : 0)];
    if (queue.add(ray, instance)) cast_together(queue, is_turned);
  }

  /// Casts at all that still wait.
  void finish() {
    for (std::size_t i = 0; i < queues_.size(); ++i)
      if (queues_[i].size() != 0) cast_together(queues_[i], i % 2 == 1);
  }

 private:
  using Queue = PairQueue<packet_lanes<T>>;

  Ray<T> seen(std::uint32_t ray, std::uint32_t instance) const {
    return instances_.seen_by(instance, rays_[ray].ray, rays_[ray].time);
  }

  void cast_alone(std::uint32_t ray, std::uint32_t instance) {
    const CastResult<T> result = cast_ray(instances_.at(instance), seen(ray, instance), options_);
    counts_.add_cast(result);
    if (result.found()) on_found_(ray, instance, result.t(), [&] { return result; });
  }

  void cast_together(Queue& queue, bool are_turned) {
    RayPacket<T> packet;
    PosePacket<T> poses;
    poses.are_turned = are_turned;
    const int used = queue.size();
    if (instances_.move()) {
      for (int i = 0; i < packet_lanes<T>; ++i) {
        const int pair = i < used ? i : 0;
        packet.set(i, seen(queue.ray(pair), queue.instance(pair)));
        poses.set(i, instances_.at(queue.instance(pair)));
      }
    } else {
      // Number by number, as the lanes are read.
      constexpr auto lanes = static_cast<std::size_t>(packet_lanes<T>);
      const T *ray[lanes], *centre[lanes], *map[lanes];
      for (std::size_t i = 0; i < lanes; ++i) {
        const int pair = static_cast<int>(i) < used ? static_cast<int>(i) : 0;
        ray[i] = rays_[queue.ray(pair)].ray.origin.data();
        centre[i] = instances_.centre(queue.instance(pair)).data();
        map[i] = instances_.to_inner(queue.instance(pair)).data();
      }
      static_assert(offsetof(Ray<T>, direction) == 3 * sizeof(T) &&
                    offsetof(Ray<T>, t_max) == 6 * sizeof(T));
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < lanes; ++i) {
          poses.centre[k][i] = centre[i][k];
          packet.origin[k][i] = ray[i][k];
          packet.direction[k][i] = ray[i][3 + k];
        }
      for (std::size_t i = 0; i < lanes; ++i) packet.t_max[i] = ray[i][6];
      if (const auto* const lows = instances_.lows())
        for (std::size_t i = 0; i < lanes; ++i) {
          const auto& low =
              lows[queue.instance(static_cast<int>(i) < used ? static_cast<int>(i) : 0)];
          for (std::size_t k = 0; k < 3; ++k)
            poses.centre_low[k][i] = low.centre[static_cast<Eigen::Index>(k)];
          poses.loss[i] = low.loss;
        }
      if (are_turned)
        for (std::size_t k = 0; k < 9; ++k)
          for (std::size_t i = 0; i < lanes; ++i)
            poses.to_inner[k][i] = map[i][3 * (k % 3) + k / 3];
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
  std::vector<Queue> queues_;  ///< two for each definition, or none
};

}  // namespace minkray
