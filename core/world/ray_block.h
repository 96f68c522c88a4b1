// SPDX-License-Identifier: MIT
// Up to 64 rays from one point that run nearly alike, such as a camera's for 8 by 8 pixels: one
// walk through the hierarchy for what bounds them all, float lanes that find for each ray which
// instance it meets first, and one exact cast for it.
#pragma once

#include "core/bvh/bvh.h"
#include "core/cast/packet_cast.h"
#include "core/screen/screen.h"
#include "core/world/instances.h"

namespace minkray {

inline constexpr std::size_t rays_of_block = 64;

/// Rays of a block. Numbers are parameters of the rays.
struct alignas(32) BlockAnswer {
  /// Indexed by ray: nothing beyond `limit` is of interest; `lo` is the earliest parameter at
  /// which the sure hit's instance is met, infinite if there is none.
  float limit[rays_of_block], lo[rays_of_block];
  std::uint32_t instance[rays_of_block];  ///< the one that is surely met first, or no_instance
  /// Pairs that may be met before that, or instead of it.
  struct Other {
    float first;
    std::uint32_t ray, instance;
  };
  static constexpr std::size_t most_others = 512;
  Other others[most_others];
  std::size_t other_count;
  std::uint32_t nodes;
};

/// Data that a block is traced through.
struct BlockWorld {
  const BvhNode* nodes;
  const InstancePlace* places;
  const Screen* screens;
  const RayKinds* shown_to;  ///< by instance; null if all are shown
};

/// Rays lie `stride` bytes apart and are all of these kinds; `limits` by ray, or null: nothing
/// beyond is of interest. False if the rays do not run alike, or too much is undecided. On machines
/// that have AVX2 and FMA.
bool trace_block_avx2(const BlockWorld& world, const char* rays, std::size_t stride,
                      std::size_t count, RayKinds kinds, const float* limits, BlockAnswer& answer);

/// Four pairs of a ray and an instance of one body whose definition has a form.
struct FourPairs {
  const double* ray[4];  ///< Ray<double>
  const InstancePlace* place[4];
  const TrailingDigits* digits[4];  ///< null if there are none
};

/// cast_ray for the lanes; those in doubt are neither hit, inside nor miss. On machines that have
/// AVX2 and FMA.
void cast_four_avx2(const InstanceBody& body, const FourPairs& pairs, LaneBits lanes,
                    CastPacket<double>& answers);

}  // namespace minkray
