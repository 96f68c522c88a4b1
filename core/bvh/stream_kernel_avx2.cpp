// SPDX-License-Identifier: MIT
// Rays take turns, one node each (Fuetterer et al., "Efficient Ray Tracing Kernels for Modern CPU
// Architectures", 2015). No step branches on the boxes that the ray meets: boxes are compressed
// into queues and sorted by a network. All functions have internal linkage or the lanes' type in
// their name (core/math/wide.h explains why).
#include "core/bvh/slab_test.h"
#include "core/bvh/sorted_lanes.h"
#include "core/bvh/stream.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

using Lanes = Wide<float, 8, IsaAvx2>;

/// Number of rays that take turns (docs/decisions/many-rays.md).
constexpr std::uint32_t turns = 32;

/// Entries below each stack that are never dropped, so that drop_distant stops there.
constexpr int sentinels = 8;
constexpr int stack_size = sentinels + bvh_max_depth * (bvh_width - 1) + 1 + bvh_width;

/// Pairs are queued until there are at least this many. Each of the parallel steps adds up to eight
/// pairs.
constexpr std::uint32_t pairs_at_once = 8, queue_size = 2 * most_pairs_at_once;

/// The nodes that a ray has yet to visit, with the parameters at which it enters their boxes. The
/// nearest node is on top.
struct Turn {
  std::uint32_t ray;
  int top;
  float enter[stack_size];
  std::uint32_t node[stack_size];
};

void store(std::uint32_t* to, __m256i lanes) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), lanes);
}

void begin(Turn& turn, std::uint32_t ray) {
  turn.ray = ray;
  turn.top = sentinels + 1;
  turn.enter[sentinels] = 0;
  turn.node[sentinels] = 0;
}

/// Drops nodes beyond t_max from the top of the stack. Returns false if no node is left.
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

namespace {

/// Number of rays that take a step together, phase by phase, so that the processor overlaps their
/// operations. Without this, it would overlap only about one step (docs/decisions/many-rays.md).
constexpr std::uint32_t abreast = 4;

/// State of a step between its phases.
template <std::uint32_t count>
struct Steps {
  Turn* turn[count];
  const SlabNumbers* ray[count];
  const BvhNode* node[count];
  __m256 enter[count], leave[count];
  __m256i children[count], keys[count];
  std::uint32_t boxes[count], inner[count];
};

template <std::uint32_t count>
[[gnu::always_inline]] inline void take_steps(Steps<count>& at, const BvhNode* nodes,
                                              std::uint32_t* pair_rays, std::uint32_t* pair_boxes,
                                              std::uint32_t& pairs) {
  const __m256i lane_numbers = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i lane_bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  const __m256i without_lane = _mm256_set1_epi32(~7);
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < count; ++k) {
    at.enter[k] = _mm256_setzero_ps();
    at.leave[k] = _mm256_set1_ps(at.ray[k]->t_max);
  }
#pragma GCC unroll 3
  for (int axis = 0; axis < 3; ++axis)
#pragma GCC unroll 8
    for (std::uint32_t k = 0; k < count; ++k) {
      const SlabNumbers& ray = *at.ray[k];
      const float* const near_plane = at.node[k]->planes[ray.near[axis]][axis];
      const float* const far_plane = at.node[k]->planes[1 - ray.near[axis]][axis];
      const __m256 in = _mm256_mul_ps(
          _mm256_sub_ps(_mm256_load_ps(near_plane), _mm256_set1_ps(ray.origin_near[axis])),
          _mm256_set1_ps(ray.inverse_near[axis]));
      const __m256 out = _mm256_mul_ps(
          _mm256_sub_ps(_mm256_load_ps(far_plane), _mm256_set1_ps(ray.origin_far[axis])),
          _mm256_set1_ps(ray.inverse_far[axis]));
      // Same as std::max and std::min: the order of operands drops NaN.
      at.enter[k] = _mm256_max_ps(in, at.enter[k]);
      at.leave[k] = _mm256_min_ps(out, at.leave[k]);
    }
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < count; ++k) {
    const __m256 padded = _mm256_add_ps(_mm256_mul_ps(at.leave[k], _mm256_set1_ps(slab_padding)),
                                        _mm256_set1_ps(slab_tiny));
    const auto met = static_cast<std::uint32_t>(
        _mm256_movemask_ps(_mm256_cmp_ps(at.enter[k], padded, _CMP_LE_OQ)));
    at.children[k] = _mm256_load_si256(reinterpret_cast<const __m256i*>(at.node[k]->children));
    const auto leaves =
        static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(at.children[k])));
    const auto absent = static_cast<std::uint32_t>(_mm256_movemask_ps(
        _mm256_castsi256_ps(_mm256_cmpeq_epi32(at.children[k], _mm256_set1_epi32(-1)))));
    at.boxes[k] = met & leaves & ~absent;
    at.inner[k] = met & ~leaves;
  }
  // Makes keys that sort nodes, the furthest first. The low bits of the entry parameter are
  // replaced by the lane's number. Parameters are not negative, so their bits compare like
  // integers. All other lanes come last.
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < count; ++k) {
    const __m256i is_other = _mm256_cmpeq_epi32(
        _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(at.inner[k])), lane_bit),
        _mm256_setzero_si256());
    at.keys[k] = _mm256_or_si256(
        _mm256_or_si256(_mm256_and_si256(_mm256_castps_si256(at.enter[k]), without_lane),
                        lane_numbers),
        is_other);
  }
  // Appends the boxes to the queue.
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < count; ++k) {
    store(pair_boxes + pairs,
          _mm256_and_si256(_mm256_permutevar8x32_epi32(at.children[k], lanes_of(at.boxes[k])),
                           _mm256_set1_epi32(~static_cast<int>(BvhNode::leaf))));
    store(pair_rays + pairs, _mm256_set1_epi32(static_cast<int>(at.turn[k]->ray)));
    pairs += static_cast<std::uint32_t>(__builtin_popcount(at.boxes[k]));
  }
  sort_keys(at.keys);
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < count; ++k) {
    Turn& turn = *at.turn[k];
    _mm256_storeu_ps(turn.enter + turn.top,
                     _mm256_castsi256_ps(_mm256_and_si256(at.keys[k], without_lane)));
    store(turn.node + turn.top, _mm256_permutevar8x32_epi32(at.children[k], at.keys[k]));
    turn.top += __builtin_popcount(at.inner[k]);
  }
#pragma GCC unroll 8
  for (std::uint32_t k = 0; k < count; ++k) {
    const Turn& turn = *at.turn[k];
    const char* const ahead = reinterpret_cast<const char*>(
        nodes + turn.node[turn.top > sentinels ? turn.top - 1 : sentinels]);
    for (int line = 0; line < 4; ++line) __builtin_prefetch(ahead + 64 * line);
  }
}

}  // namespace

namespace {

/// Same as detail::float_above, for four numbers.
[[gnu::always_inline]] inline __m128 floats_above(__m256d x) {
  const __m128 nearest = _mm256_cvtpd_ps(x);
  const __m256d is_below = _mm256_cmp_pd(_mm256_cvtps_pd(nearest), x, _CMP_LT_OQ);
  // -1 if `nearest` is below x, else 0.
  const __m128i step = _mm256_castsi256_si128(_mm256_permutevar8x32_epi32(
      _mm256_castpd_si256(is_below), _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6)));
  // Zero counts as positive.
  const __m128i bits =
      _mm_castps_si128(_mm_andnot_ps(_mm_cmpeq_ps(nearest, _mm_setzero_ps()), nearest));
  const __m128i is_negative = _mm_srai_epi32(bits, 31);
  // Subtracts `step` from positive bits, and adds it to negative ones.
  return _mm_castsi128_ps(
      _mm_sub_epi32(bits, _mm_sub_epi32(_mm_xor_si128(step, is_negative), is_negative)));
}

}  // namespace

void make_slabs_avx2(const char* rays, std::size_t stride, std::size_t count, SlabRay* slabs) {
  static_assert(offsetof(SlabNumbers, origin_far) == 12 &&
                offsetof(SlabNumbers, inverse_near) == 24 &&
                offsetof(SlabNumbers, inverse_far) == 36 && offsetof(SlabNumbers, t_max) == 48 &&
                offsetof(SlabNumbers, near) == 52 && offsetof(SlabRay, steps) >= 64);
  const __m256d sign = _mm256_set1_pd(-0.0);
  for (std::size_t i = 0; i < count; ++i, rays += stride) {
    const double* const from = reinterpret_cast<const double*>(rays);
    const __m256d o = _mm256_loadu_pd(from);
    __m256d d = _mm256_loadu_pd(from + 3);
    const double x = std::abs(from[3]), y = std::abs(from[4]), z = std::abs(from[5]);
    const double xy = x > y ? x : y, largest = xy > z ? xy : z;
    SlabRay& to = slabs[i];
    to.steps = 1;
    if (!(largest >= 0.5 && largest < 2)) {
      constexpr double most = 0x1p1000;
      if (!(largest > 1 / most && largest < most)) [[unlikely]] {
        to = SlabRay(*reinterpret_cast<const Ray<double>*>(from));
        continue;
      }
      // 2^e above the largest component, and 2^-e, by their exponents' bits.
      constexpr std::uint64_t exponent = 0x7FFull << 52, one = 1ull << 52, sum = 0x7FEull << 52;
      const std::uint64_t steps = (std::bit_cast<std::uint64_t>(largest) & exponent) + one;
      to.steps = std::bit_cast<double>(steps);
      d = _mm256_mul_pd(d, _mm256_set1_pd(std::bit_cast<double>(sum - steps)));
    }
    const __m256d turn = _mm256_and_pd(d, sign), turned = _mm256_xor_pd(o, turn);
    const __m128 turn_float = _mm256_cvtpd_ps(turn);  // +0 or -0
    const __m128 origin_near = _mm_xor_ps(floats_above(turned), turn_float);
    const __m128 origin_far = _mm_xor_ps(
        _mm_xor_ps(floats_above(_mm256_xor_pd(turned, sign)), _mm_set1_ps(-0.0f)), turn_float);
    const __m128 inverse = _mm256_cvtpd_ps(_mm256_div_pd(_mm256_set1_pd(1), d));
    // Inverses too large for float remain finite.
    const __m128 absolute = _mm_andnot_ps(_mm_set1_ps(-0.0f), inverse);
    const __m128 bounded =
        _mm_or_ps(_mm_min_ps(absolute, _mm_set1_ps(std::numeric_limits<float>::max())),
                  _mm_and_ps(inverse, _mm_set1_ps(-0.0f)));
    const __m256d is_zero = _mm256_cmp_pd(d, _mm256_setzero_pd(), _CMP_EQ_OQ);
    const __m128 zero = _mm_castsi128_ps(_mm256_castsi256_si128(_mm256_permutevar8x32_epi32(
        _mm256_castpd_si256(is_zero), _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6))));
    float* const numbers = to.numbers.origin_near;
    _mm_storeu_ps(numbers, origin_near);
    _mm_storeu_ps(numbers + 3, origin_far);
    _mm_storeu_ps(numbers + 6, _mm_blendv_ps(bounded, inverse, zero));
    _mm_storeu_ps(numbers + 9, inverse);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to.numbers.near),
                     _mm_srli_epi32(_mm_castps_si128(turn_float), 31));
    to.numbers.t_max = to.limit(from[6]);
  }
}

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
  // Prepares step k with the next node of the turn at open[i]. Returns false if the turn has no
  // more rays.
  const auto ready = [&](auto& steps, std::uint32_t k, std::uint32_t i) {
    Turn& turn = all[open[i]];
    while (!drop_distant(turn, rays[turn.ray].numbers.t_max)) {
      if (next >= rays_left) return false;
      begin(turn, next++);
    }
    steps.turn[k] = &turn;
    steps.ray[k] = &rays[turn.ray].numbers;
    steps.node[k] = nodes + turn.node[--turn.top];
    return true;
  };
  const auto tell = [&] {
    if (pairs < pairs_at_once) return;
    visitor.visit(visitor.context, pair_rays, pair_boxes, pairs);
    pairs = 0;
  };
  while (opened != 0) {
    for (std::uint32_t i = 0; i < opened;) {
      Steps<abreast> steps;
      std::uint32_t k = 0;
      for (; k < abreast && i < opened;) {
        if (ready(steps, k, i)) {
          ++k;
          ++i;
        } else
          open[i] = open[--opened];
      }
      visited += k;
      if (k == abreast) [[likely]]
        take_steps<abreast>(steps, nodes, pair_rays, pair_boxes, pairs);
      else
        for (std::uint32_t alone = 0; alone < k; ++alone) {
          Steps<1> step;
          step.turn[0] = steps.turn[alone];
          step.ray[0] = steps.ray[alone];
          step.node[0] = steps.node[alone];
          take_steps<1>(step, nodes, pair_rays, pair_boxes, pairs);
        }
      tell();
    }
  }
  if (pairs != 0) visitor.visit(visitor.context, pair_rays, pair_boxes, pairs);
  return visited;
}

}  // namespace minkray
#else
namespace minkray {

/// Never called on machines without AVX2.
void make_slabs_avx2(const char*, std::size_t, std::size_t, SlabRay*) {}
std::uint64_t walk_stream_avx2(const BvhNode*, SlabRay*, std::size_t, const PairVisitor&) {
  return 0;
}

}  // namespace minkray
#endif
