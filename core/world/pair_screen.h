// SPDX-License-Identifier: MIT
// Sorts out pairs of a ray and an instance before any is cast at: queues by the kind of closed
// form, whatever the sizes, and eight pairs at a time in float lanes, whose intervals say who can
// be met first. What is left over is about one pair a ray.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/bvh/ray_group.h"
#include "core/bvh/stream.h"
#include "core/cast/screen.h"
#include "core/world/pair_caster.h"

namespace minkray {

/// How far each ray goes on: what it may still meet lies no further than what it surely meets.
struct RayLimits {
  std::vector<SlabRay> slabs;
  std::vector<float> t;            ///< not below the T that it stands for
  std::vector<std::uint8_t> sure;  ///< 1: it is that of a pair which has not been cast at yet

  template <class T>
  explicit RayLimits(std::span<const WorldRay<T>> rays) : sure(rays.size()) {
    t.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i)
      t[i] = detail::float_above(static_cast<double>(rays[i].ray.t_max));
    // Streams are asked for on machines with AVX2 alone.
    if constexpr (std::is_same_v<T, double>) {
      slabs.resize(rays.size());
      make_slabs_avx2(reinterpret_cast<const char*>(&rays.data()->ray), sizeof(WorldRay<T>),
                      rays.size(), slabs.data());
    } else {
      slabs.reserve(rays.size());
      for (const WorldRay<T>& one : rays) slabs.emplace_back(one.ray);
    }
  }
  /// Nothing else is asked of this ray.
  void end(std::size_t ray) {
    t[ray] = -1;
    slabs[ray].numbers.t_max = -1;
  }
  /// It is met at t at the latest.
  void lower(std::size_t ray, double at) {
    const float above = detail::float_above(at);
    if (!(above < t[ray])) return;
    t[ray] = above;
    slabs[ray].numbers.t_max = slabs[ray].limit(at);
  }
};

/// Caster is a PairCaster. on_sure(ray, t) is told of pairs that surely meet, at t at the latest,
/// before they are cast at; it says whether they are to be cast at then.
template <class T, class Caster, class OnSure>
class PairScreen {
 public:
  PairScreen(const Instances<T>& instances, std::span<const WorldRay<T>> rays, RayLimits& limits,
             Caster& caster, OnSure on_sure)
      : instances_(instances),
        rays_(rays),
        limits_(limits),
        caster_(caster),
        on_sure_(std::move(on_sure)) {}

  /// Pairs wait until the next ones come, and their instances' places with them.
  void take(const std::uint32_t* rays, const std::uint32_t* instances, std::size_t pairs) {
    sort_waiting();
    for (std::size_t i = 0; i < pairs; ++i) {
      instances_.prefetch_place(instances[i]);
      waiting_[waiting_count_++] = {rays[i], instances[i]};
    }
  }

  /// Looks at all that still wait, and casts at what is left of all.
  void finish() {
    sort_waiting();
    for (std::size_t kind = 0; kind < form_kinds; ++kind)
      if (queues_[kind].size() != 0) look_at(queues_[kind], static_cast<FormKind>(kind));
    caster_.finish();
    for (const auto& [ray, instance, first] : left_)
      if (first <= limits_.t[ray]) caster_.add(ray, instance);
    left_.clear();
    caster_.finish();
  }

 private:
  struct Pair {
    std::uint32_t ray, instance;
  };
  struct Left {
    std::uint32_t ray, instance;
    float first;
  };
  using Queue = PairQueue<screen_lanes>;

  void sort_waiting() {
    for (std::size_t i = 0; i < waiting_count_; ++i) {
      const auto [ray, instance] = waiting_[i];
      instances_.prefetch_map(instance);
      sort(ray, instance);
    }
    waiting_count_ = 0;
  }

  void sort(std::uint32_t ray, std::uint32_t instance) {
    if (instances_.is_half_space(instance) || rays_[ray].passes(instances_, instance)) return;
    const FormKind kind = instances_.screen_of(instance).kind;
    if (kind == FormKind::none) return caster_.add(ray, instance);
    Queue& queue = queues_[static_cast<std::size_t>(kind)];
    if (queue.add(ray, instance)) look_at(queue, kind);
  }

  void look_at(Queue& queue, FormKind kind) {
    ScreenPairs<T> pairs;
    std::array<Ray<T>, screen_lanes> seen;
    const int used = queue.size();
    for (int i = 0; i < screen_lanes; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      const int pair = i < used ? i : 0;
      const std::uint32_t ray = queue.ray(pair), instance = queue.instance(pair);
      pairs.ray[lane] = &rays_[ray].ray;
      if (instances_.move()) {
        seen[lane] = instances_.seen_by(instance, rays_[ray].ray, rays_[ray].time);
        pairs.ray[lane] = &seen[lane];
      }
      pairs.centre[lane] = &instances_.centre(instance);
      pairs.to_inner[lane] = &instances_.to_inner(instance);
      pairs.form[lane] = &instances_.screen_of(instance).form;
    }
    Screened answers;
    screen_avx2(kind, pairs, answers);
    for (int i = 0; i < used; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      const std::uint32_t ray = queue.ray(i), instance = queue.instance(i);
      const float first = answers.first[lane], last = answers.last[lane];
      constexpr float never = std::numeric_limits<float>::infinity();
      if (first == never || !(first <= limits_.t[ray])) continue;
      if (!instances_.screen_of(instance).is_whole)
        caster_.add(ray, instance);
      else if (last == never || last > limits_.t[ray] || on_sure_(ray, last))
        left_.push_back({ray, instance, first});
    }
    queue.clear();
  }

  const Instances<T>& instances_;
  std::span<const WorldRay<T>> rays_;
  RayLimits& limits_;
  Caster& caster_;
  OnSure on_sure_;
  std::array<Pair, most_pairs_at_once> waiting_;
  std::size_t waiting_count_ = 0;
  std::array<Queue, form_kinds> queues_;
  std::vector<Left> left_;
};

}  // namespace minkray
