// SPDX-License-Identifier: MIT
// Interface of every ray tracer that is measured on whole scenes. Rays come in batches, so that
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
  /// For each ray the instance that it leaves; if empty, none leaves one. Tracers that can, leave
  /// it out; the rays begin above its surface, so that none must.
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

  /// Kinds of calls that it supports: "packets", "stream".
  virtual std::vector<std::string> entries() const = 0;
  virtual std::unique_ptr<RayQueue> queue(std::size_t entry) const = 0;
  /// The normal has unit length and points outwards.
  virtual Vec3<float> world_normal(const FirstHit& hit) const = 0;

  /// Memory use that it reports.
  virtual std::size_t bytes() const = 0;
  /// The part of the building that the hierarchy over all instances took, in seconds.
  virtual double hierarchy_seconds() const = 0;
};

}  // namespace minkray::bench
