// SPDX-License-Identifier: MIT
// Casts pairs of a ray and an instance exactly. Pairs whose shape has a closed form are queued and
// cast four at a time. All other pairs are sorted by instance.
#pragma once

#include <algorithm>
#include <vector>

#include "core/world/ray_block.h"
#include "core/world/world_ray.h"

namespace minkray {

/// A ray and an instance that it may hit, at t >= `first`.
struct OpenPair {
  std::uint32_t ray, instance;
  float first;
};

/// True if the instance's shape has no closed form, so that its pairs are cast last.
inline bool is_formless(const Instances& instances, std::uint32_t instance) {
  return instances.body_of(instance).definition->form().kind == FormKind::none;
}

/// Calls on_found(ray, instance, t, result) for each pair whose ray hits the instance or starts
/// inside it. `result` is a function that returns the CastResult.
template <class OnFound>
class PairCaster {
 public:
  PairCaster(const Instances& instances, const CastOptions& options, const RaySpan& rays,
             QueryCounts& counts, OnFound on_found)
      : instances_(instances),
        options_(options),
        rays_(rays),
        counts_(counts),
        on_found_(std::move(on_found)) {
    // Queues are worthwhile only if there are enough rays to fill them.
    has_queues_ = instances.bodies().size() <= rays.size() && !instances.move();
  }

  void add(std::uint32_t ray, std::uint32_t instance) {
    const std::uint32_t body = instances_.places()[instance].body;
    const InstanceBody& of = instances_.bodies()[body];
    if (!has_queues_ || of.is_wide || of.definition->form().kind == FormKind::none)
      return cast_alone(ray, instance);
    if (queues_.empty()) queues_.resize(instances_.bodies().size());
    Queue& queue = queues_[body];
    queue.ray[queue.count] = ray;
    queue.instance[queue.count++] = instance;
    if (queue.count == lanes) cast_together(queue, of);
  }

  /// Casts all pairs that are still queued.
  void finish() {
    for (std::size_t body = 0; body < queues_.size(); ++body)
      if (queues_[body].count != 0) cast_together(queues_[body], instances_.bodies()[body]);
  }

  /// Casts pairs whose shapes have no closed form, in the order of instances and lower bounds.
  /// is_due(pair) returns true if the pair can still change the result.
  template <class IsDue>
  void cast_formless(std::vector<OpenPair>& pairs, const IsDue& is_due) {
    std::sort(pairs.begin(), pairs.end(), [](const OpenPair& a, const OpenPair& b) {
      return a.instance != b.instance ? a.instance < b.instance : a.first < b.first;
    });
    for (std::size_t i = 0; i < pairs.size();) {
      const std::uint32_t instance = pairs[i].instance;
      RayPacket packet;
      std::uint32_t ray_of[lanes];
      int used = 0;
      for (; i < pairs.size() && pairs[i].instance == instance && used < int{lanes}; ++i) {
        if (!is_due(pairs[i])) continue;
        ray_of[used] = pairs[i].ray;
        packet.set(used++, seen(pairs[i].ray, instance));
      }
      if (used == 0) continue;
      const PreparedShape shape = instances_.at(instance);
      if (used == 1 || !shape.definition().has_packets() || instances_.move()) {
        for (int lane = 0; lane < used; ++lane) cast_alone(ray_of[lane], instance);
        continue;
      }
      for (int lane = used; lane < int{lanes}; ++lane) packet.set(lane, packet.ray(0));
      CastPacket answers;
      cast_packet(shape, packet, (LaneBits(1) << used) - 1, answers);
      for (int lane = 0; lane < used; ++lane) {
        const CastResult<double> result = answers.result(lane);
        count(ray_of[lane], result);
        if (result.found()) on_found_(ray_of[lane], instance, result.t(), [&] { return result; });
      }
    }
    pairs.clear();
  }

  /// Returns the rays with a cast that did not converge. The list may contain a ray several times.
  const std::vector<std::uint32_t>& exhausted() const { return exhausted_; }

 private:
  static constexpr std::uint8_t lanes = 4;
  struct Queue {
    std::size_t count = 0;
    std::uint32_t ray[lanes], instance[lanes];
  };

  Ray<double> seen(std::uint32_t ray, std::uint32_t instance) const {
    return instances_.seen_by(instance, rays_.ray(ray), rays_.time(ray));
  }

  void cast_alone(std::uint32_t ray, std::uint32_t instance) {
    const CastResult<double> result =
        cast_ray(instances_.at_seen_by(instance, rays_.ray(ray)), seen(ray, instance), options_);
    count(ray, result);
    if (result.found()) on_found_(ray, instance, result.t(), [&] { return result; });
  }

  void count(std::uint32_t ray, const CastResult<double>& result) {
    counts_.add_cast(result);
    if (result.status == Status::exhausted) exhausted_.push_back(ray);
  }

  void cast_together(Queue& queue, const InstanceBody& body) {
    FourPairs pairs;
    for (std::size_t i = 0; i < lanes; ++i) {
      const std::size_t from = i < queue.count ? i : 0;
      const std::uint32_t instance = queue.instance[from];
      pairs.ray[i] = reinterpret_cast<const double*>(&rays_.ray(queue.ray[from]));
      pairs.place[i] = instances_.places() + instance;
      pairs.digits[i] = instances_.digits() ? instances_.digits() + instance : nullptr;
    }
    CastPacket answers;
    const std::size_t used = queue.count;
    cast_four_avx2(body, pairs, (LaneBits(1) << used) - 1, answers);
    const LaneBits answered = answers.found() | answers.miss;
    counts_.add_filtered(static_cast<std::uint64_t>(__builtin_popcount(answered)));
    for (std::size_t i = 0; i < used; ++i) {
      const int lane = static_cast<int>(i);
      if (!(answered >> i & 1u))
        cast_alone(queue.ray[i], queue.instance[i]);
      else if (answers.found() >> i & 1u)
        on_found_(queue.ray[i], queue.instance[i], answers.t(lane),
                  [&] { return answers.result(lane); });
    }
    queue.count = 0;
  }

  const Instances& instances_;
  const CastOptions& options_;
  RaySpan rays_;
  QueryCounts& counts_;
  OnFound on_found_;
  bool has_queues_;
  std::vector<Queue> queues_;             ///< indexed by body; empty if queues are not used
  std::vector<std::uint32_t> exhausted_;  ///< rays with a cast that did not converge
};

}  // namespace minkray
