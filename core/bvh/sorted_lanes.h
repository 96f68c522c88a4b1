// SPDX-License-Identifier: MIT
// Orders AVX2 lanes: moves the lanes of a set to the front, and sorts the keys of several registers
// at once with a sorting network. All functions have internal linkage (core/math/wide.h explains
// why).
#pragma once

#include <cstdint>

#include "core/math/wide.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

/// Table: for each set of lanes, the numbers of the lanes in the set, in ascending order.
struct LanesOfSet {
  std::uint64_t lanes[256] = {};
  constexpr LanesOfSet() {
    for (std::uint32_t set = 0; set < 256; ++set)
      for (std::uint32_t lane = 0, count = 0; lane < 8; ++lane)
        if (set >> lane & 1) lanes[set] |= static_cast<std::uint64_t>(lane) << (8 * count++);
  }
};
constexpr LanesOfSet lanes_of_set;

/// Numbers of the lanes in the set, one per lane from the front.
inline __m256i lanes_of(std::uint32_t set) {
  return _mm256_cvtepu8_epi32(
      _mm_cvtsi64_si128(static_cast<std::int64_t>(lanes_of_set.lanes[set])));
}

/// Returns the larger of the two keys in the lanes of the set `upper_lanes`, the smaller in others.
template <int upper_lanes>
__m256i compared(__m256i keys, __m256i others) {
  return _mm256_blend_epi32(_mm256_min_epi32(keys, others), _mm256_max_epi32(keys, others),
                            upper_lanes);
}

/// Sorts the lanes of each register, the largest first.
template <std::uint32_t count>
[[gnu::always_inline]] inline void sort_keys(__m256i (&keys)[count]) {
#define MINKRAY_LAYER(upper, shuffled)                                \
  _Pragma("GCC unroll 8") for (std::uint32_t k = 0; k < count; ++k) { \
    const __m256i of = keys[k];                                       \
    keys[k] = compared<upper>(of, shuffled);                          \
  }
  MINKRAY_LAYER(0x55, _mm256_shuffle_epi32(of, 0xB1))
  MINKRAY_LAYER(0x33, _mm256_shuffle_epi32(of, 0x1B))
  MINKRAY_LAYER(0x55, _mm256_shuffle_epi32(of, 0xB1))
  MINKRAY_LAYER(0x0F, _mm256_permutevar8x32_epi32(of, _mm256_setr_epi32(7, 6, 5, 4, 3, 2, 1, 0)))
  MINKRAY_LAYER(0x33, _mm256_shuffle_epi32(of, 0x4E))
  MINKRAY_LAYER(0x55, _mm256_shuffle_epi32(of, 0xB1))
#undef MINKRAY_LAYER
}

}  // namespace
}  // namespace minkray
#endif
