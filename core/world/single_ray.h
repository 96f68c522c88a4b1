// SPDX-License-Identifier: MIT
// Traces one ray through the BVH, near boxes first. Float lanes screen the instances of a node
// together; the caller then casts the ray at the instances that it may hit.
#pragma once

#include <array>

#include "core/bvh/slab_ray.h"
#include "core/screen/screen.h"
#include "core/world/instances.h"

namespace minkray {

/// Scene data for tracing a single ray.
struct SingleWorld {
  const BvhNode* nodes;
  const InstancePlace* places;
  const TrailingDigits* digits;  ///< null if there are none
  const Screen* screens;
  const RayKinds* shown_to;  ///< indexed by instance; null if all are shown to all rays
};

struct SingleRay {
  const Ray<double>* ray;
  SlabRay slabs;
  std::uint32_t skip;  ///< instance that the ray ignores, or no_instance
  RayKinds kinds;
  /// Upper limit of t. When a hit is certain, the limit is lowered to that hit's upper bound.
  float limit;
  bool is_sure = false;       ///< the ray certainly hits an instance
  bool ends_if_sure = false;  ///< the first certain hit ends the search
  /// An instance that the ray may hit, at t >= `first`.
  struct Candidate {
    std::uint32_t instance;
    float first;
  };
  static constexpr std::size_t most_candidates = 64;
  std::array<Candidate, most_candidates> candidates;
  std::size_t candidate_count = 0;
  std::uint32_t nodes = 0;  ///< number of visited nodes
};

/// Finds the ray's candidates. Returns false if there are more than most_candidates. Requires AVX2
/// and FMA.
bool trace_single_avx2(const SingleWorld& world, SingleRay& ray);

}  // namespace minkray
