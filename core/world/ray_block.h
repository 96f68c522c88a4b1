// SPDX-License-Identifier: MIT
// Traces a block: up to 64 rays from one point in similar directions, such as a camera's rays for 8
// by 8 pixels. All rays share one traversal of the BVH; it tests boxes against common bounds of the
// rays' directions. Tests in float SIMD lanes then find, for each ray, the first instance that it
// certainly hits; usually each ray needs an exact cast at only this instance.
#pragma once

#include "core/bvh/bvh.h"
#include "core/cast/packet_cast.h"
#include "core/screen/screen.h"
#include "core/world/instances.h"

namespace minkray {

inline constexpr std::size_t rays_of_block = 64;

/// Result for the rays of a block. All floats are values of the ray parameter t.
struct alignas(32) BlockAnswer {
  /// Indexed by ray. A hit is certain if float lanes have proven it. `limit` is an upper limit of
  /// t: at first the ray's own, then an upper bound of t for the certain hit. Hits beyond `limit`
  /// do not matter. `lo` is a lower bound of t for the certain hit; infinite for rays without one.
  float limit[rays_of_block], lo[rays_of_block];
  std::uint32_t instance[rays_of_block];  ///< instance of the certain hit, or no_instance
  /// A ray and an instance that it may hit at t >= `first`, before the certain hit if there is one.
  struct Other {
    float first;
    std::uint32_t ray, instance;
  };
  static constexpr std::size_t most_others = 512;
  Other others[most_others];  ///< the first `other_count` are valid
  std::size_t other_count;
  std::uint32_t nodes;  ///< number of visited BVH nodes
};

/// Scene data for tracing a block.
struct BlockWorld {
  const BvhNode* nodes;
  const InstancePlace* places;
  const Screen* screens;
  const RayKinds* shown_to;  ///< indexed by instance; null if all are shown to all rays
};

/// Traces `count` rays, stored `stride` bytes apart, that all have the kinds `kinds`. `limits` has
/// an upper limit of t per ray, or is null. Returns false if the directions differ too much, or if
/// too many pairs of a ray and an instance are undecided. Requires AVX2 and FMA.
bool trace_block_avx2(const BlockWorld& world, const char* rays, std::size_t stride,
                      std::size_t count, RayKinds kinds, const float* limits, BlockAnswer& answer);

/// Four pairs of a ray and an instance. All instances have the same InstanceBody, whose definition
/// has a closed form.
struct FourPairs {
  const double* ray[4];  ///< Ray<double>
  const InstancePlace* place[4];
  const TrailingDigits* digits[4];  ///< null if there are none
};

/// Casts the pairs of the given lanes. The results are the same as those of cast_ray. A lane that
/// the closed form cannot decide is neither hit, inside nor miss. Requires AVX2 and FMA.
void cast_four_avx2(const InstanceBody& body, const FourPairs& pairs, LaneBits lanes,
                    CastPacket& answers);

}  // namespace minkray
