// SPDX-License-Identifier: MIT
// Traces one ray through the hierarchy, near boxes first: float lanes screen the instances of a
// node together, and those that may be met are left to be cast at.
#pragma once

#include <array>

#include "core/bvh/slab_ray.h"
#include "core/screen/screen.h"
#include "core/world/instances.h"

namespace minkray {

/// Data that a single ray is traced through.
struct SingleWorld {
  const BvhNode* nodes;
  const InstancePlace* places;
  const Screen* screens;
  const RayKinds* shown_to;  ///< by instance; null if all are shown
};

struct SingleRay {
  const Ray<double>* ray;
  SlabRay slabs;
  std::uint32_t skip;
  RayKinds kinds;
  /// Nothing beyond is of interest. Lowered to where an instance is surely met at the latest.
  float limit;
  bool is_sure = false;       ///< an instance is surely met
  bool ends_if_sure = false;  ///< that one is met is all that matters
  /// Instances that may be met, and where at the earliest.
  struct Candidate {
    std::uint32_t instance;
    float first;
  };
  static constexpr std::size_t most_candidates = 64;
  std::array<Candidate, most_candidates> candidates;
  std::size_t candidate_count = 0;
  std::uint32_t nodes = 0;  ///< visited
};

/// False if there are too many candidates. On machines that have AVX2 and FMA.
bool trace_single_avx2(const SingleWorld& world, SingleRay& ray);

}  // namespace minkray
