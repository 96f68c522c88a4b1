// SPDX-License-Identifier: MIT
// An Embree scene that counts its memory, and the four kinds of calls: one ray, eight rays, a
// stream of single rays, a stream of packets of eight. As everywhere in the benchmarks, Embree is
// used with its fastest (not its robust) intersection.
#pragma once

#include <embree3/rtcore.h>

#include <atomic>

#include "bench/image/tracer.h"

namespace minkray::bench {

class EmbreeScene {
 public:
  explicit EmbreeScene(int threads);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCDevice device() const { return device_; }
  RTCScene scene() const { return scene_; }
  std::size_t bytes() const { return static_cast<std::size_t>(bytes_.load()); }

 private:
  static bool count(void* self, ssize_t bytes, bool after);

  std::atomic<ssize_t> bytes_{0};
  RTCDevice device_;
  RTCScene scene_;
};

/// Number of a hit that identifies its instance.
enum class EmbreeNumber : unsigned char { instance, geometry, primitive };

std::vector<std::string> embree_entries();
std::unique_ptr<RayQueue> embree_queue(RTCScene scene, EmbreeNumber number, std::size_t entry);

}  // namespace minkray::bench
