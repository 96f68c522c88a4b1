// SPDX-License-Identifier: MIT
// Traverses a hierarchy with a group: up to 32 rays from one point whose directions have the same
// signs, such as a camera's. Nodes are tested with bounds of all rays; each child to be visited is
// then tested with the slabs of the single rays, side by side. Everything here has internal
// linkage.
#pragma once

#include "core/bvh/group_walk.h"

#if defined(__AVX2__)

#include <immintrin.h>

#include <cmath>

namespace minkray {
namespace {

constexpr std::size_t group_rows = rays_of_group / 8;

[[gnu::always_inline]] inline float least_of(__m256 x) {
  x = _mm256_min_ps(x, _mm256_permute2f128_ps(x, x, 1));
  x = _mm256_min_ps(x, _mm256_permute_ps(x, 0x4E));
  return _mm256_cvtss_f32(_mm256_min_ps(x, _mm256_permute_ps(x, 0xB1)));
}
[[gnu::always_inline]] inline float greatest_of(__m256 x) {
  x = _mm256_max_ps(x, _mm256_permute2f128_ps(x, x, 1));
  x = _mm256_max_ps(x, _mm256_permute_ps(x, 0x4E));
  return _mm256_cvtss_f32(_mm256_max_ps(x, _mm256_permute_ps(x, 0xB1)));
}
[[gnu::always_inline]] inline float least_of(const float (&of)[rays_of_group]) {
  __m256 least = _mm256_load_ps(of);
  for (std::size_t row = 1; row < group_rows; ++row)
    least = _mm256_min_ps(least, _mm256_load_ps(of + 8 * row));
  return least_of(least);
}
[[gnu::always_inline]] inline float greatest_of(const float (&of)[rays_of_group]) {
  __m256 greatest = _mm256_load_ps(of);
  for (std::size_t row = 1; row < group_rows; ++row)
    greatest = _mm256_max_ps(greatest, _mm256_load_ps(of + 8 * row));
  return greatest_of(greatest);
}

/// Slabs of all rays, side by side; unused lanes meet nothing.
class RayGroup {
 public:
  /// False if the rays do not form a group.
  bool take(const SlabRay* rays, std::size_t count) {
    bool is_alike = true;
    for (std::size_t k = 0; k < 3; ++k) {
      near_[k] = rays[0].numbers.near[k];
      origin_near_[k] = rays[0].numbers.origin_near[k];
      origin_far_[k] = rays[0].numbers.origin_far[k];
    }
    for (std::size_t i = 0; i < count; ++i) {
      const SlabNumbers& numbers = rays[i].numbers;
      for (std::size_t k = 0; k < 3; ++k) {
        is_alike &= numbers.near[k] == near_[k] && numbers.origin_near[k] == origin_near_[k] &&
                    numbers.origin_far[k] == origin_far_[k] &&
                    std::abs(numbers.inverse_far[k]) < std::numeric_limits<float>::max();
        inverse_[k][i] = numbers.inverse_far[k];
      }
      t_max_[i] = numbers.t_max;
    }
    for (std::size_t i = count; i < rays_of_group; ++i) {
      for (std::size_t k = 0; k < 3; ++k) inverse_[k][i] = rays[0].numbers.inverse_far[k];
      t_max_[i] = -1;
    }
    return is_alike;
  }

  /// For rays that are given four at a time: takes the signs and the origin from the first one.
  void begin(const SlabNumbers& first) {
    for (std::size_t k = 0; k < 3; ++k) {
      near_[k] = first.near[k];
      origin_near_[k] = first.origin_near[k];
      origin_far_[k] = first.origin_far[k];
    }
  }
  /// Sets rays i to i + 3 by their directions, the size of the largest component, and t_max, as
  /// SlabRay does. Returns 0 if they belong to the group, and their steps.
  [[gnu::always_inline]] int set_four(std::size_t i, const __m256d (&direction)[3], __m256d largest,
                                      __m256d t_max, double* steps) {
    const auto all = [](double x) { return _mm256_set1_pd(x); };
    constexpr double most = 0x1p1000;
    int is_other =
        _mm256_movemask_pd(_mm256_or_pd(_mm256_cmp_pd(largest, all(1 / most), _CMP_NGT_UQ),
                                        _mm256_cmp_pd(largest, all(most), _CMP_NLT_UQ)));
    // Powers of two by their exponents' bits.
    const __m256i exponent = _mm256_set1_epi64x(0x7FFll << 52), one = _mm256_set1_epi64x(1ll << 52),
                  sum = _mm256_set1_epi64x(0x7FEll << 52);
    const __m256i above =
        _mm256_add_epi64(_mm256_and_si256(_mm256_castpd_si256(largest), exponent), one);
    const __m256d is_near_one = _mm256_and_pd(_mm256_cmp_pd(largest, all(0.5), _CMP_GE_OQ),
                                              _mm256_cmp_pd(largest, all(2), _CMP_LT_OQ));
    const __m256d times = _mm256_blendv_pd(_mm256_castsi256_pd(above), all(1), is_near_one);
    const __m256d scale =
        _mm256_blendv_pd(_mm256_castsi256_pd(_mm256_sub_epi64(sum, above)), all(1), is_near_one);
    _mm256_store_pd(steps, times);
    for (std::size_t k = 0; k < 3; ++k) {
      const __m128 inverse =
          _mm256_cvtpd_ps(_mm256_div_pd(all(1), _mm256_mul_pd(direction[k], scale)));
      const __m128 is_finite = _mm_cmplt_ps(_mm_andnot_ps(_mm_set1_ps(-0.0f), inverse),
                                            _mm_set1_ps(std::numeric_limits<float>::max()));
      constexpr int lanes = 15;
      is_other |= lanes & ~_mm_movemask_ps(is_finite);
      is_other |= _mm_movemask_ps(inverse) ^ (near_[k] != 0 ? lanes : 0);
      _mm_store_ps(inverse_[k] + i, inverse);
    }
    _mm_store_ps(t_max_ + i, _mm_add_ps(_mm_mul_ps(_mm256_cvtpd_ps(_mm256_mul_pd(t_max, times)),
                                                   _mm_set1_ps(hit_padding)),
                                        _mm_set1_ps(slab_tiny)));
    return is_other;
  }
  /// After the last of `count` rays.
  void end(std::size_t count) {
    for (std::size_t i = count; i < rays_of_group; ++i) {
      for (std::size_t k = 0; k < 3; ++k) inverse_[k][i] = inverse_[k][0];
      t_max_[i] = -1;
    }
  }

  /// Lowers the limit of a ray; false if the limit is already as low.
  bool lower(std::size_t ray, float t_max) {
    if (!(t_max < t_max_[ray])) return false;
    t_max_[ray] = t_max;
    return true;
  }

  /// Calls on_box(box, rays) for the boxes that rays meet, near boxes first; `rays` has a bit for
  /// each of these rays. on_box returns true if it has lowered a limit. Calls fetch(child) some
  /// time before a child is visited. Returns the number of nodes.
  template <class OnBox, class Fetch>
  [[gnu::always_inline]] std::uint64_t walk(const BvhNode* nodes, OnBox&& on_box, Fetch&& fetch) {
    struct Waiting {
      float enter;
      std::uint32_t node, child;
    };
    Waiting stack[bvh_max_depth * (bvh_width - 1) + 1 + bvh_width];
    int top = 0;
    std::uint32_t node_number = 0;
    std::uint64_t visited = 0;
    float inverse_low[3], inverse_high[3];
    for (std::size_t k = 0; k < 3; ++k) {
      inverse_low[k] = least_of(inverse_[k]);
      inverse_high[k] = greatest_of(inverse_[k]);
    }
    float t_max = greatest_of(t_max_);
    for (;;) {
      ++visited;
      const BvhNode& node = nodes[node_number];
      // Inverses have one sign: products with the least and the greatest bound the products with
      // all others, since rounding keeps their order.
      __m256 enter = _mm256_setzero_ps(), leave = _mm256_set1_ps(t_max);
      for (std::size_t k = 0; k < 3; ++k) {
        const __m256 low = _mm256_set1_ps(inverse_low[k]), high = _mm256_set1_ps(inverse_high[k]);
        const __m256 in = _mm256_sub_ps(_mm256_load_ps(node.planes[near_[k]][k]),
                                        _mm256_set1_ps(origin_near_[k]));
        const __m256 out = _mm256_sub_ps(_mm256_load_ps(node.planes[1 - near_[k]][k]),
                                         _mm256_set1_ps(origin_far_[k]));
        enter =
            _mm256_max_ps(_mm256_min_ps(_mm256_mul_ps(in, low), _mm256_mul_ps(in, high)), enter);
        leave =
            _mm256_min_ps(_mm256_max_ps(_mm256_mul_ps(out, low), _mm256_mul_ps(out, high)), leave);
      }
      const __m256 padded = _mm256_add_ps(_mm256_mul_ps(leave, _mm256_set1_ps(slab_padding)),
                                          _mm256_set1_ps(slab_tiny));
      auto met =
          static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(enter, padded, _CMP_LE_OQ)));
      alignas(32) float enters[8];
      _mm256_store_ps(enters, enter);
      for (const int bottom = top; met != 0; met &= met - 1) {
        const auto child = static_cast<std::uint32_t>(__builtin_ctz(met));
        if (node.children[child] == BvhNode::none) break;
        fetch(node.children[child]);
        int at = top++;
        for (; at > bottom && stack[at - 1].enter < enters[child]; --at) stack[at] = stack[at - 1];
        stack[at] = {enters[child], node_number, child};
      }
      for (;;) {
        if (top == 0) return visited;
        const Waiting next = stack[--top];
        if (!(next.enter <= t_max)) continue;
        const BvhNode& of = nodes[next.node];
        const std::uint32_t what = of.children[next.child];
        const bool is_box = (what & BvhNode::leaf) != 0;
        const std::uint32_t in = rays_in(of, next.child, is_box);
        if (in == 0) continue;
        if (!is_box) {
          node_number = what;
          break;
        }
        if (on_box(what & ~BvhNode::leaf, in)) t_max = greatest_of(t_max_);
      }
    }
  }

 private:
  /// Returns the rays that meet a child's box. Unless `all` is set, stops after the first row of
  /// rays in which any ray meets the box.
  [[gnu::always_inline]] std::uint32_t rays_in(const BvhNode& node, std::uint32_t child,
                                               bool all) const {
    std::uint32_t in = 0;
    for (std::size_t row = 0; row < group_rows; ++row) {
      __m256 enter = _mm256_setzero_ps(), leave = _mm256_load_ps(t_max_ + 8 * row);
      for (std::size_t k = 0; k < 3; ++k) {
        const __m256 inverse = _mm256_load_ps(inverse_[k] + 8 * row);
        enter = _mm256_max_ps(
            _mm256_mul_ps(_mm256_set1_ps(node.planes[near_[k]][k][child] - origin_near_[k]),
                          inverse),
            enter);
        leave = _mm256_min_ps(
            _mm256_mul_ps(_mm256_set1_ps(node.planes[1 - near_[k]][k][child] - origin_far_[k]),
                          inverse),
            leave);
      }
      const __m256 padded = _mm256_add_ps(_mm256_mul_ps(leave, _mm256_set1_ps(slab_padding)),
                                          _mm256_set1_ps(slab_tiny));
      in |= static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(enter, padded, _CMP_LE_OQ)))
            << (8 * row);
      if (!all && in != 0) return in;
    }
    return in;
  }

  alignas(32) float inverse_[3][rays_of_group], t_max_[rays_of_group];
  float origin_near_[3], origin_far_[3];  ///< as in SlabNumbers (slab_ray.h), as is near_
  int near_[3] = {};
};

}  // namespace
}  // namespace minkray
#endif
