// SPDX-License-Identifier: MIT
// A block of rays in float lanes: made from rays in double, and tested against boxes. All functions
// have internal linkage (core/math/wide.h explains why).
#pragma once

#include "core/bvh/bvh.h"
#include "core/bvh/sorted_lanes.h"
#include "core/screen/form_in_lanes.h"
#include "core/world/ray_block.h"

#if defined(__AVX2__)
namespace minkray {
namespace {

constexpr int all_rays = static_cast<int>(rays_of_block);
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Largest difference between a ray's direction and the block's middle direction, relative to the
/// largest component of the middle direction. Blocks with larger differences save no time.
constexpr double widest = 0.25;

/// Padding of box tests, for 16 roundings. Tests compare two ray parameters with five roundings
/// each.
constexpr float block_padding = 1 + 8 * std::numeric_limits<float>::epsilon();

struct alignas(32) Block {
  /// Indexed by axis and ray: the direction minus the middle direction, and 1 / direction, which is
  /// never infinite.
  float delta[3][all_rays], inverse[3][all_rays];
  double origin[4], middle[4];  ///< the common origin; the middle direction
  double middle_squared;
  double widest;  ///< greatest length of a direction minus the middle direction
  /// The origin rounded up and down to float, and bounds of `inverse` over all rays.
  float above[3], below[3];
  float inverse_near[3], inverse_far[3];
  /// For axes with directions of both signs (`mixed`): the inverses closest to zero of each sign.
  float least_up[3], least_down[3];
  bool down[3], mixed[3];  ///< by axis: some directions go down; some go up and some down
};

__m256d load(const double* from) {
  return _mm256_loadu_pd(from);
}

/// Transposes four rows of four numbers.
[[gnu::always_inline]] inline void transpose(const __m256d (&row)[4], __m256d (&column)[4]) {
  const __m256d a = _mm256_unpacklo_pd(row[0], row[1]), b = _mm256_unpackhi_pd(row[0], row[1]);
  const __m256d c = _mm256_unpacklo_pd(row[2], row[3]), d = _mm256_unpackhi_pd(row[2], row[3]);
  column[0] = _mm256_permute2f128_pd(a, c, 0x20);
  column[1] = _mm256_permute2f128_pd(b, d, 0x20);
  column[2] = _mm256_permute2f128_pd(a, c, 0x31);
  column[3] = _mm256_permute2f128_pd(b, d, 0x31);
}

float least_of(__m256 v) {
  __m128 x = _mm_min_ps(_mm256_castps256_ps128(v), _mm256_extractf128_ps(v, 1));
  x = _mm_min_ps(x, _mm_movehl_ps(x, x));
  return _mm_cvtss_f32(_mm_min_ss(x, _mm_shuffle_ps(x, x, 1)));
}
float greatest_of(__m256 v) {
  __m128 x = _mm_max_ps(_mm256_castps256_ps128(v), _mm256_extractf128_ps(v, 1));
  x = _mm_max_ps(x, _mm_movehl_ps(x, x));
  return _mm_cvtss_f32(_mm_max_ss(x, _mm_shuffle_ps(x, x, 1)));
}

float above(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafterf(f, infinity) : f;
}
float below(double x) {
  return -above(-x);
}

bool make_block(const char* rays, std::size_t stride, std::size_t count, Block& block,
                float* limits) {
  const auto ray = [&](std::size_t i) {
    return reinterpret_cast<const double*>(rays + stride * i);
  };
  const double *const first = ray(0), *const last = ray(count - 1);
  for (int axis = 0; axis < 3; ++axis) {
    block.origin[axis] = first[axis];
    if (first[axis] != last[axis]) return false;
    block.middle[axis] = 0.5 * (first[3 + axis] + last[3 + axis]);
  }
  block.origin[3] = block.middle[3] = 0;
  const double* const m = block.middle;
  const double size = std::max(std::max(std::abs(m[0]), std::abs(m[1])), std::abs(m[2]));
  if (!(size > 0x1p-20 && size < 0x1p20)) return false;
  block.middle_squared = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];

  const __m256d origin[3] = {_mm256_set1_pd(first[0]), _mm256_set1_pd(first[1]),
                             _mm256_set1_pd(first[2])};
  const __m256d middle[3] = {_mm256_set1_pd(m[0]), _mm256_set1_pd(m[1]), _mm256_set1_pd(m[2])};
  __m256d differ = _mm256_setzero_pd();
  __m256 wide = _mm256_setzero_ps();
  __m256 least[3], most[3];
  for (int axis = 0; axis < 3; ++axis) {
    least[axis] = _mm256_set1_ps(infinity);
    most[axis] = _mm256_set1_ps(-infinity);
  }
  const __m256 sign = _mm256_set1_ps(-0.0f);
  const __m256 tiny = _mm256_set1_ps(static_cast<float>(size * 0x1p-60));
  for (std::size_t from = 0; from < rays_of_block; from += 8) {
    __m128 direction[3][2], delta[3][2], limit[2];
    for (std::size_t half = 0; half < 2; ++half) {
      __m256d row[4], column[4];
      const double* at[4];
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t k = from + 4 * half + i;
        at[i] = ray(k < count ? k : 0);
        row[i] = load(at[i]);
      }
      transpose(row, column);
      for (int axis = 0; axis < 3; ++axis)
        differ = _mm256_or_pd(differ, _mm256_cmp_pd(column[axis], origin[axis], _CMP_NEQ_UQ));
      for (std::size_t i = 0; i < 4; ++i) row[i] = load(at[i] + 3);
      transpose(row, column);
      for (int axis = 0; axis < 3; ++axis) {
        direction[axis][half] = _mm256_cvtpd_ps(column[axis]);
        delta[axis][half] = _mm256_cvtpd_ps(_mm256_sub_pd(column[axis], middle[axis]));
      }
      limit[half] = _mm256_cvtpd_ps(column[3]);
    }
    __m256 squared = _mm256_setzero_ps();
    for (int axis = 0; axis < 3; ++axis) {
      const __m256 d = _mm256_set_m128(direction[axis][1], direction[axis][0]);
      const __m256 e = _mm256_set_m128(delta[axis][1], delta[axis][0]);
      const __m256 safe =
          _mm256_or_ps(_mm256_max_ps(_mm256_andnot_ps(sign, d), tiny), _mm256_and_ps(sign, d));
      const __m256 inverse = _mm256_div_ps(_mm256_set1_ps(1), safe);
      _mm256_store_ps(block.delta[axis] + from, e);
      _mm256_store_ps(block.inverse[axis] + from, inverse);
      squared = _mm256_fmadd_ps(e, e, squared);
      least[axis] = _mm256_min_ps(least[axis], inverse);
      most[axis] = _mm256_max_ps(most[axis], inverse);
    }
    wide = _mm256_max_ps(wide, squared);
    _mm256_store_ps(limits + from, _mm256_mul_ps(_mm256_set_m128(limit[1], limit[0]),
                                                 _mm256_set1_ps(1 + 0x1p-22f)));
  }
  if (_mm256_movemask_pd(differ) != 0) return false;
  for (std::size_t i = count; i < rays_of_block; ++i) limits[i] = -1;
  block.widest = std::sqrt(static_cast<double>(greatest_of(wide))) * (1 + 0x1p-20);
  if (!(block.widest < widest * size)) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const float low = least_of(least[axis]), high = greatest_of(most[axis]);
    block.above[axis] = above(first[axis]);
    block.below[axis] = below(first[axis]);
    block.mixed[axis] = low < 0 && high > 0;
    block.down[axis] = low < 0;
    // Near planes need the inverse that gives the least t, far planes the one for the greatest t.
    block.inverse_near[axis] = low < 0 ? high : low;
    block.inverse_far[axis] = low < 0 ? low : high;
    if (!block.mixed[axis]) continue;
    block.least_up[axis] = infinity;
    block.least_down[axis] = -infinity;
    for (const float inverse : block.inverse[axis]) {
      if (inverse > 0) block.least_up[axis] = std::min(block.least_up[axis], inverse);
      if (inverse < 0) block.least_down[axis] = std::max(block.least_down[axis], inverse);
    }
  }
  return true;
}

/// Returns one bit per box of the node: 1 if any ray may meet the box up to t_max. Writes lower
/// bounds of the ray parameters at which rays enter the boxes.
[[gnu::always_inline]] inline std::uint32_t boxes_met(const BvhNode& node, const Block& block,
                                                      float t_max, float* enters) {
  __m256 enter = _mm256_setzero_ps(), leave = _mm256_set1_ps(t_max);
  for (int axis = 0; axis < 3; ++axis) {
    const __m256 lower =
        _mm256_sub_ps(_mm256_load_ps(node.planes[0][axis]), _mm256_set1_ps(block.above[axis]));
    const __m256 upper =
        _mm256_sub_ps(_mm256_load_ps(node.planes[1][axis]), _mm256_set1_ps(block.below[axis]));
    if (block.mixed[axis]) {
      enter = _mm256_max_ps(_mm256_mul_ps(lower, _mm256_set1_ps(block.least_up[axis])), enter);
      enter = _mm256_max_ps(_mm256_mul_ps(upper, _mm256_set1_ps(block.least_down[axis])), enter);
      continue;
    }
    const __m256 near = block.down[axis] ? upper : lower, far = block.down[axis] ? lower : upper;
    enter = _mm256_max_ps(_mm256_mul_ps(near, _mm256_set1_ps(block.inverse_near[axis])), enter);
    leave = _mm256_min_ps(_mm256_mul_ps(far, _mm256_set1_ps(block.inverse_far[axis])), leave);
  }
  _mm256_store_ps(enters, enter);
  const __m256 padded = _mm256_add_ps(_mm256_mul_ps(leave, _mm256_set1_ps(block_padding)),
                                      _mm256_set1_ps(std::numeric_limits<float>::min()));
  return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(enter, padded, _CMP_LE_OQ)));
}

}  // namespace
}  // namespace minkray
#endif
