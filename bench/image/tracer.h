// SPDX-License-Identifier: MIT
// What every ray tracer that is measured on whole scenes looks like. Rays come in batches, so that
// each can have its best case: one by one, eight at a time, or as a stream. Everything around the
// casts, from rays to colours, is the same code for all of them (frame.h).
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/math/ray.h"
#include "core/world/world.h"

namespace minkray::bench {

/// The numbers are floats, whatever the tracer casts in.
struct RaySpan {
  std::span<const Ray<float>> rays;
  /// It names for each ray the instance that it leaves; if it is empty, none leaves one. Those who
  /// can, leave it out; the rays begin above its surface, so that nobody must.
  std::span<const std::uint32_t> leaves = {};
  bool coherent = false;  ///< neighbours start close to each other and go nearly the same way

  std::size_t size() const { return rays.size(); }
};

struct FirstHit {
  float t = std::numeric_limits<float>::infinity();
  std::uint32_t instance = no_instance;
  Vec3<float> normal = Vec3<float>::Zero();  ///< the tracer's own; see Tracer::world_normal

  bool found() const { return instance != no_instance; }
};

/// Answers batches of rays; one for each thread.
class RayQueue {
 public:
  RayQueue() = default;
  virtual ~RayQueue() = default;
  RayQueue(const RayQueue&) = delete;
  RayQueue& operator=(const RayQueue&) = delete;

  /// The rays in the tracer's own layout. Before every cast: tracers write into it.
  virtual void prepare(const RaySpan& rays) = 0;
  /// One answer a ray that was prepared.
  virtual void first_hits(std::span<FirstHit> hits) = 0;
  virtual void occluded(std::span<unsigned char> answers) = 0;
};

class Tracer {
 public:
  Tracer() = default;
  virtual ~Tracer() = default;
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// How it can be asked: "packets", "stream".
  virtual std::vector<std::string> entries() const = 0;
  virtual std::unique_ptr<RayQueue> queue(std::size_t entry) const = 0;
  /// The normal has unit length and points outwards.
  virtual Vec3<float> world_normal(const FirstHit& hit) const = 0;

  /// What it says of itself.
  virtual std::size_t bytes() const = 0;
  /// The part of the building that the hierarchy over all instances took, in seconds.
  virtual double hierarchy_seconds() const = 0;
};

}  // namespace minkray::bench
