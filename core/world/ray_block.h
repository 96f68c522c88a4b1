// SPDX-License-Identifier: MIT
// Up to 64 rays from one point that run nearly alike, such as a camera's for 8 by 8 pixels: one walk
// through the hierarchy for what bounds them all, lanes of floats that find for each ray which
// instance it meets first, and one exact cast for it.
#pragma once

#include "core/bvh/bvh.h"
#include "core/cast/packet_cast.h"
#include "core/cast/screen.h"
#include "core/world/leaf_place.h"

namespace minkray {

inline constexpr std::size_t rays_of_block = 64;

inline constexpr std::uint32_t no_leaf = ~std::uint32_t{0};

/// What lanes found. Numbers are parameters of the rays.
struct alignas(32) BlockAnswer {
  /// By ray: nothing beyond `limit` is of interest; `lo` is where at the earliest the instance that
  /// is surely met is met, infinite if there is none.
  float limit[rays_of_block], lo[rays_of_block];
  std::uint32_t leaf[rays_of_block];  ///< its place, or no_leaf
  /// Pairs that may be met before that, or instead of it.
  struct Other {
    float first;
    std::uint32_t ray, leaf;
  };
  static constexpr std::size_t most_others = 256;
  Other others[most_others];
  std::size_t other_count;
  std::uint32_t nodes;
};

/// The answers of a block, four by four.
struct BlockHits {
  std::array<CastPacket<double>, rays_of_block / 4> casts;
  std::array<std::uint32_t, rays_of_block> instance;
  std::uint64_t found;  ///< bits of rays whose answers are hits, or inside
  std::uint64_t alone;  ///< bits of rays that must be asked for alone
};

/// What a block is asked of.
struct BlockWorld {
  FormKind kind;
  const BvhNode* nodes;
  const LeafPlace<double>* places;
  const std::uint32_t* first_leaves;
  const Screen* screens;
};

/// False if the rays are not such, and nothing was done. They follow each other `stride` bytes
/// apart. Only on machines that have AVX2 and FMA.
bool look_at_block_avx2(const BlockWorld& world, const char* rays, std::size_t stride,
                        std::size_t count, BlockAnswer& answer);

/// Four rays, each at an instance of its own of one definition with a form.
struct FourPairs {
  const double* ray[4];  ///< Ray<double>
  const double *centre[4], *to_inner[4];
};

/// cast_ray for the lanes; those in doubt are neither hit, inside nor miss.
/// cast_ray for the lanes; those in doubt are neither hit, inside nor miss.
void cast_four_avx2(const ShapeDefinition<double>& definition, const FourPairs& pairs,
                    LaneBits lanes, CastPacket<double>& answers);

}  // namespace minkray
