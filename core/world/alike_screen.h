// SPDX-License-Identifier: MIT
// Looks at pairs of a ray and an instance where all instances are of one kind of closed form, stand
// still and are shown to all rays: no queue is sorted, and what lanes read of an instance is one
// line of the cache.
#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "core/bvh/stream.h"
#include "core/cast/screen.h"
#include "core/world/pair_screen.h"

namespace minkray {

/// on_open(ray, instance, first, last, is_sure) is told of pairs that may be met.
template <class T, class OnOpen>
class AlikeScreen {
 public:
  AlikeScreen(const Instances<T>& instances, std::span<const WorldRay<T>> rays,
              const RayLimits& limits, OnOpen on_open)
      : kind_(instances.kind_of_all()),
        list_{reinterpret_cast<const char*>(&rays.data()->ray), sizeof(WorldRay<T>),
              reinterpret_cast<const char*>(instances.lane_places()), instances.screens(),
              limits.t.data()},
        rays_(rays),
        on_open_(std::move(on_open)) {}

  /// Pairs wait until the next ones come, and their instances with them.
  void take(const std::uint32_t* rays, const std::uint32_t* instances, std::size_t pairs) {
    std::size_t from = 0;
    for (; from + screen_lanes <= count_; from += screen_lanes) look_at(from, screen_lanes);
    count_ -= from;
    std::memmove(ray_, ray_ + from, sizeof(std::uint32_t) * screen_lanes);
    std::memmove(instance_, instance_ + from, sizeof(std::uint32_t) * screen_lanes);
    std::memcpy(ray_ + count_, rays, sizeof(std::uint32_t) * most_pairs_at_once);
    std::memcpy(instance_ + count_, instances, sizeof(std::uint32_t) * most_pairs_at_once);
    for (std::size_t i = 0; i < pairs; ++i)
      __builtin_prefetch(list_.places + std::size_t{64} * instances[i]);
    count_ += pairs;
  }

  void finish() {
    for (std::size_t from = 0; from < count_; from += screen_lanes) {
      const std::size_t used = std::min<std::size_t>(screen_lanes, count_ - from);
      for (std::size_t i = used; i < screen_lanes; ++i) {
        ray_[from + i] = ray_[from];
        instance_[from + i] = instance_[from];
      }
      look_at(from, used);
    }
    count_ = 0;
  }

 private:
  void look_at(std::size_t from, std::size_t used) {
    Screened answers;
    const ScreenBits bits =
        screen_list_avx2<T>(kind_, list_, ray_ + from, instance_ + from, answers);
    for (std::uint32_t open = bits.open & ((1u << used) - 1u); open != 0; open &= open - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(open));
      const std::uint32_t ray = ray_[from + lane], instance = instance_[from + lane];
      if (rays_[ray].skip == instance) continue;
      on_open_(ray, instance, answers.first[lane], answers.last[lane],
               (bits.sure >> lane & 1u) != 0);
    }
  }

  FormKind kind_;
  ScreenList<T> list_;
  std::span<const WorldRay<T>> rays_;
  OnOpen on_open_;
  std::size_t count_ = 0;
  std::uint32_t ray_[2 * screen_lanes + 2 * most_pairs_at_once] = {};
  std::uint32_t instance_[2 * screen_lanes + 2 * most_pairs_at_once] = {};
};

}  // namespace minkray
