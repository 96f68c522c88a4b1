// SPDX-License-Identifier: MIT
// Traces up to 64 rays from one point with similar directions, such as a camera's rays for 8 by 8
// pixels. One BVH traversal uses the bounds of all rays; float lanes find the first instance for
// each ray; then each ray needs one exact cast.
#pragma once

#include "core/bvh/bvh.h"
#include "core/cast/packet_cast.h"
#include "core/screen/screen.h"
#include "core/world/instances.h"

namespace minkray {

inline constexpr std::size_t rays_of_block = 64;

/// Result for the rays of a block. Numbers are ray parameters.
struct alignas(32) BlockAnswer {
  /// Indexed by ray. Hits beyond `limit` do not matter. `lo` is a lower bound of t for the ray's
  /// certain hit, or infinite if there is none.
  float limit[rays_of_block], lo[rays_of_block];
  std::uint32_t instance[rays_of_block];  ///< of the certain hit, or no_instance
  /// Pairs that may hit before the certain hit, or although there is no certain hit.
  struct Other {
    float first;
    std::uint32_t ray, instance;
  };
  static constexpr std::size_t most_others = 512;
  Other others[most_others];
  std::size_t other_count;
  std::uint32_t nodes;
};

/// Scene data for tracing a block.
struct BlockWorld {
  const BvhNode* nodes;
  const InstancePlace* places;
  const Screen* screens;
  const RayKinds* shown_to;  ///< by instance; null if all are shown
};

/// Traces `count` rays, stored `stride` bytes apart, that all have the same kinds. `limits` (or
/// null) has an upper limit of t per ray. Returns false if the directions differ too much, or if
/// too many pairs are undecided. Requires AVX2 and FMA.
bool trace_block_avx2(const BlockWorld& world, const char* rays, std::size_t stride,
                      std::size_t count, RayKinds kinds, const float* limits, BlockAnswer& answer);

/// Four pairs of a ray and an instance of one body whose definition has a form.
struct FourPairs {
  const double* ray[4];  ///< Ray<double>
  const InstancePlace* place[4];
  const TrailingDigits* digits[4];  ///< null if there are none
};

/// Same as cast_ray for the given lanes. A lane that cannot be decided is neither hit, inside nor
/// miss. Requires AVX2 and FMA.
void cast_four_avx2(const InstanceBody& body, const FourPairs& pairs, LaneBits lanes,
                    CastPacket& answers);

}  // namespace minkray
