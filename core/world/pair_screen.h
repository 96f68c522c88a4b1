// SPDX-License-Identifier: MIT
// Screens the pairs of a ray and an instance that a BVH traversal finds. Pairs are queued by the
// kind of the instance's closed form, and tested eight at a time in float lanes, which discard most
// of them. The pairs that may hit are passed on.
#pragma once

#include <array>
#include <cstring>
#include <vector>

#include "core/bvh/stream.h"
#include "core/screen/screen.h"
#include "core/world/world_ray.h"

namespace minkray {

/// Upper limit of t for each ray: hits beyond the first certain hit do not matter.
struct RayLimits {
  std::vector<SlabRay> slabs;
  std::vector<float> t;            ///< rounded up from double
  std::vector<std::uint8_t> sure;  ///< 1: the limit is from a certain hit that is not cast yet

  explicit RayLimits(const RaySpan& rays) : slabs(rays.size()), t(rays.size()), sure(rays.size()) {
    for (std::size_t i = 0; i < rays.size(); ++i) t[i] = detail::float_above(rays.ray(i).t_max);
    make_slabs_avx2(rays.data(), rays.stride(), rays.size(), slabs.data());
  }
  /// Ends the ray: further instances are ignored.
  void end(std::size_t ray) {
    t[ray] = -1;
    slabs[ray].numbers.t_max = -1;
  }
  /// Lowers the limit to t = `at`, an upper bound of the first hit.
  void lower(std::size_t ray, double at) {
    const float above = detail::float_above(at);
    if (!(above < t[ray])) return;
    t[ray] = above;
    slabs[ray].numbers.t_max = slabs[ray].limit(at);
  }
};

/// Calls on_open(ray, instance, first, last, is_sure) for each pair that may hit. A hit can only be
/// at t >= first. If `is_sure`, there is a hit for certain, at t <= last.
template <class OnOpen>
class PairScreen {
 public:
  /// `kind_of_all` is the kind of all instances' closed forms, or none if kinds differ.
  PairScreen(const Instances& instances, FormKind kind_of_all, const RaySpan& rays,
             const RayLimits& limits, OnOpen on_open)
      : instances_(instances),
        kind_of_all_(instances.move() ? FormKind::none : kind_of_all),
        list_{rays.data(), rays.stride(), instances.places(), instances.screens(), limits.t.data()},
        rays_(rays),
        on_open_(std::move(on_open)) {}

  /// Takes new pairs. Prefetches the instances' poses now, and screens the pairs in the next call.
  void take(const std::uint32_t* rays, const std::uint32_t* instances, std::size_t pairs) {
    if (kind_of_all_ != FormKind::none) {
      std::size_t from = 0;
      for (; from + screen_lanes <= count_; from += screen_lanes)
        look_at(kind_of_all_, ray_ + from, instance_ + from, screen_lanes);
      count_ -= from;
      std::memmove(ray_, ray_ + from, sizeof(std::uint32_t) * screen_lanes);
      std::memmove(instance_, instance_ + from, sizeof(std::uint32_t) * screen_lanes);
    } else {
      sort_waiting();
    }
    std::memcpy(ray_ + count_, rays, sizeof(std::uint32_t) * most_pairs_at_once);
    std::memcpy(instance_ + count_, instances, sizeof(std::uint32_t) * most_pairs_at_once);
    for (std::size_t i = 0; i < pairs; ++i) instances_.prefetch(instances[i]);
    count_ += pairs;
  }

  void finish() {
    if (kind_of_all_ != FormKind::none) {
      for (std::size_t from = 0; from < count_; from += screen_lanes)
        look_at(kind_of_all_, ray_ + from, instance_ + from,
                std::min<std::size_t>(screen_lanes, count_ - from));
      count_ = 0;
      return;
    }
    sort_waiting();
    for (std::size_t kind = 0; kind < form_kinds; ++kind) {
      Queue& queue = queues_[kind];
      if (queue.count != 0)
        look_at(static_cast<FormKind>(kind), queue.ray, queue.instance, queue.count);
      queue.count = 0;
    }
  }

 private:
  struct Queue {
    std::size_t count = 0;
    std::uint32_t ray[screen_lanes], instance[screen_lanes];
  };

  /// Sorts the waiting pairs into queues by kind.
  void sort_waiting() {
    for (std::size_t i = 0; i < count_; ++i) {
      const std::uint32_t ray = ray_[i], instance = instance_[i];
      const FormKind kind = list_.screens[list_.places[instance].body].kind;
      if (kind == FormKind::none) {
        if (!rays_.passes(instances_, ray, instance)) on_open_(ray, instance, 0.0f, 0.0f, false);
        continue;
      }
      Queue& queue = queues_[static_cast<std::size_t>(kind)];
      queue.ray[queue.count] = ray;
      queue.instance[queue.count++] = instance;
      if (queue.count < screen_lanes) continue;
      look_at(kind, queue.ray, queue.instance, screen_lanes);
      queue.count = 0;
    }
    count_ = 0;
  }

  /// Screens eight pairs. Only the first `used` pairs are valid.
  void look_at(FormKind kind, std::uint32_t* ray, std::uint32_t* instance, std::size_t used) {
    for (std::size_t i = used; i < screen_lanes; ++i) {
      ray[i] = ray[0];
      instance[i] = instance[0];
    }
    Screened answers;
    const ScreenBits bits = instances_.move()
                                ? of_moving(kind, ray, instance, used, answers)
                                : screen_avx2(kind, list_, ray, instance, used, answers);
    for (std::uint32_t open = bits.open & ((1u << used) - 1u); open != 0; open &= open - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(open));
      if (rays_.passes(instances_, ray[lane], instance[lane])) continue;
      const bool is_sure = (bits.sure >> lane & 1u) != 0 &&
                           list_.screens[list_.places[instance[lane]].body].is_whole;
      on_open_(ray[lane], instance[lane], answers.first[lane], answers.last[lane], is_sure);
    }
  }

  /// Screens pairs with moving instances: moves the rays to the instances' time 0.
  ScreenBits of_moving(FormKind kind, const std::uint32_t* ray, const std::uint32_t* instance,
                       std::size_t used, Screened& answers) const {
    std::array<Ray<double>, screen_lanes + 1> seen;  // vector loads read one item more
    std::array<float, screen_lanes> limits;
    std::array<std::uint32_t, screen_lanes> number;
    for (std::uint32_t i = 0; i < screen_lanes; ++i) {
      seen[i] = instances_.seen_by(instance[i], rays_.ray(ray[i]), rays_.time(ray[i]));
      limits[i] = list_.limits[ray[i]];
      number[i] = i;
    }
    const ScreenList list{reinterpret_cast<const char*>(seen.data()), sizeof(Ray<double>),
                          list_.places, list_.screens, limits.data()};
    return screen_avx2(kind, list, number.data(), instance, used, answers);
  }

  const Instances& instances_;
  FormKind kind_of_all_;
  ScreenList list_;
  RaySpan rays_;
  OnOpen on_open_;
  std::size_t count_ = 0;
  std::uint32_t ray_[2 * screen_lanes + 2 * most_pairs_at_once] = {};
  std::uint32_t instance_[2 * screen_lanes + 2 * most_pairs_at_once] = {};
  std::array<Queue, form_kinds> queues_;
};

}  // namespace minkray
