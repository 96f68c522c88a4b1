// SPDX-License-Identifier: MIT
// Rays take turns, a node each, and no step has a branch that depends on what was met: boxes are
// compressed into queues, and sorted by a network. After Fuetterer et al., "Efficient Ray Tracing
// Kernels for Modern CPU Architectures", 2015. Everything here has internal linkage or the type of
// the lanes in its name: see core/math/wide.h.
#include "core/bvh/slab_test.h"
#include "core/bvh/stream.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

using Lanes = Wide<float, 8, IsaAvx2>;

/// So many rays take turns (docs/decisions/streams.md has the measurement).
constexpr std::uint32_t turns = 32;

/// Entries that are always live, below each stack's first.
constexpr int sentinels = 8;
constexpr int stack_size = sentinels + bvh_max_depth * (bvh_width - 1) + 1 + bvh_width;

/// Pairs wait until there are so many; a step adds up to eight.
constexpr std::uint32_t pairs_at_once = 8, queue_size = pairs_at_once + 2 * bvh_width;
static_assert(pairs_at_once - 1 + bvh_width <= most_pairs_at_once);

/// The nodes that a ray has yet to visit, the nearest on top, and where it enters their boxes.
struct Turn {
  std::uint32_t ray;
  int top;
  float enter[stack_size];
  std::uint32_t node[stack_size];
};

/// For each set of lanes, their numbers from the lowest up.
struct LanesOfSet {
  std::uint64_t lanes[256] = {};
  constexpr LanesOfSet() {
    for (std::uint32_t set = 0; set < 256; ++set)
      for (std::uint32_t lane = 0, count = 0; lane < 8; ++lane)
        if (set >> lane & 1) lanes[set] |= static_cast<std::uint64_t>(lane) << (8 * count++);
  }
};
constexpr LanesOfSet lanes_of_set;

__m256i lanes_of(std::uint32_t set) {
  return _mm256_cvtepu8_epi32(
      _mm_cvtsi64_si128(static_cast<std::int64_t>(lanes_of_set.lanes[set])));
}

template <int upper_lanes>
__m256i compared(__m256i keys, __m256i others) {
  return _mm256_blend_epi32(_mm256_min_epi32(keys, others), _mm256_max_epi32(keys, others),
                            upper_lanes);
}

/// The greatest first, by a bitonic network.
__m256i sorted(__m256i keys) {
  keys = compared<0x55>(keys, _mm256_shuffle_epi32(keys, 0xB1));
  keys = compared<0x33>(keys, _mm256_shuffle_epi32(keys, 0x1B));
  keys = compared<0x55>(keys, _mm256_shuffle_epi32(keys, 0xB1));
  keys = compared<0x0F>(
      keys, _mm256_permutevar8x32_epi32(keys, _mm256_setr_epi32(7, 6, 5, 4, 3, 2, 1, 0)));
  keys = compared<0x33>(keys, _mm256_shuffle_epi32(keys, 0x4E));
  return compared<0x55>(keys, _mm256_shuffle_epi32(keys, 0xB1));
}

void store(std::uint32_t* to, __m256i lanes) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), lanes);
}

void begin(Turn& turn, std::uint32_t ray) {
  turn.ray = ray;
  turn.top = sentinels + 1;
  turn.enter[sentinels] = 0;
  turn.node[sentinels] = 0;
}

/// Takes what lies beyond t_max from the top. False if nothing is left.
bool drop_distant(Turn& turn, float t_max) {
  const __m256 limit = _mm256_set1_ps(t_max);
  for (;;) {
    const __m256 top = _mm256_loadu_ps(turn.enter + turn.top - 8);
    const auto live =
        static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(top, limit, _CMP_LE_OQ)));
    if (live == 0) {
      turn.top -= 8;
      continue;
    }
    turn.top -= __builtin_clz(live) - 24;
    return turn.top > sentinels;
  }
}

}  // namespace

std::uint64_t walk_stream_avx2(const BvhNode* nodes, SlabRay* rays, std::size_t count,
                               const PairVisitor& visitor) {
  Turn all[turns];
  std::uint32_t open[turns];
  std::uint32_t pair_rays[queue_size] = {}, pair_boxes[queue_size] = {};
  std::uint32_t opened = 0, next = 0, pairs = 0;
  const auto rays_left = static_cast<std::uint32_t>(count);
  std::uint64_t visited = 0;
  for (; opened < turns && next < rays_left; ++opened) {
    for (float& enter : all[opened].enter) {
      if (&enter == all[opened].enter + sentinels) break;
      enter = -std::numeric_limits<float>::infinity();
    }
    begin(all[opened], next++);
    open[opened] = opened;
  }
  const __m256i lane_numbers = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i lane_bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  const __m256i without_lane = _mm256_set1_epi32(~7);
  while (opened != 0) {
    for (std::uint32_t i = 0; i < opened;) {
      Turn& turn = all[open[i]];
      const SlabNumbers& ray = rays[turn.ray].numbers;
      const float t_max = ray.t_max;
      if (!drop_distant(turn, t_max)) {
        if (next < rays_left)
          begin(turn, next++);
        else
          open[i] = open[--opened];
        continue;
      }
      const BvhNode& node = nodes[turn.node[--turn.top]];
      ++visited;
      alignas(32) float enters[bvh_width];
      const std::uint32_t met = boxes_met<Lanes>(node, ray, t_max, enters);
      const __m256i children = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.children));
      const auto leaves =
          static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(children)));
      const auto absent = static_cast<std::uint32_t>(_mm256_movemask_ps(
          _mm256_castsi256_ps(_mm256_cmpeq_epi32(children, _mm256_set1_epi32(-1)))));
      const std::uint32_t boxes = met & leaves & ~absent, inner = met & ~leaves;
      // Boxes to the queue.
      store(pair_boxes + pairs,
            _mm256_and_si256(_mm256_permutevar8x32_epi32(children, lanes_of(boxes)),
                             _mm256_set1_epi32(~static_cast<int>(BvhNode::leaf))));
      store(pair_rays + pairs, _mm256_set1_epi32(static_cast<int>(turn.ray)));
      pairs += static_cast<std::uint32_t>(__builtin_popcount(boxes));
      // Nodes to the stack, the furthest first: where they are entered, cut off to make room for
      // the lane's number, is not negative, and so in order as a whole number. Others come last.
      const __m256i is_other =
          _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(static_cast<int>(inner)), lane_bit),
                             _mm256_setzero_si256());
      const __m256i keys = sorted(_mm256_or_si256(
          _mm256_or_si256(
              _mm256_and_si256(_mm256_castps_si256(_mm256_load_ps(enters)), without_lane),
              lane_numbers),
          is_other));
      _mm256_storeu_ps(turn.enter + turn.top,
                       _mm256_castsi256_ps(_mm256_and_si256(keys, without_lane)));
      store(turn.node + turn.top, _mm256_permutevar8x32_epi32(children, keys));
      turn.top += __builtin_popcount(inner);
      const char* const ahead = reinterpret_cast<const char*>(
          nodes + turn.node[turn.top > sentinels ? turn.top - 1 : sentinels]);
      for (int line = 0; line < 4; ++line) __builtin_prefetch(ahead + 64 * line);
      ++i;
      if (pairs < pairs_at_once) continue;
      visitor.visit(visitor.context, pair_rays, pair_boxes, pairs);
      pairs = 0;
    }
  }
  if (pairs != 0) visitor.visit(visitor.context, pair_rays, pair_boxes, pairs);
  return visited;
}

}  // namespace minkray
#else
namespace minkray {

/// Other machines never ask.
std::uint64_t walk_stream_avx2(const BvhNode*, SlabRay*, std::size_t, const PairVisitor&) {
  return 0;
}

}  // namespace minkray
#endif
