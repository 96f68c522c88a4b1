// SPDX-License-Identifier: MIT
#include "core/pair/hull_scan.h"

#include <algorithm>

#include "core/math/instruction_set.h"

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define MINKRAY_HULL_SCAN_AVX2
#endif

namespace minkray {
namespace {

constexpr int lanes = 8;

/// Lane i has the first of the best among the points i, i + 8, ...
int best_of_lanes(const double* reach, const double* index) {
  int best = 0;
  for (int i = 1; i < lanes; ++i)
    if (reach[i] > reach[best]) best = i;
  return static_cast<int>(index[best]) + best;
}

int scan(const ShapeCore& hull, double x, double y, double z) {
  double reach[lanes], index[lanes] = {};
  const auto at = [&](int i) { return x * hull.x[i] + (y * hull.y[i] + z * hull.z[i]); };
  for (int i = 0; i < lanes; ++i) reach[i] = at(i);
  for (int begin = lanes; begin < hull.count; begin += lanes)
    for (int i = 0; i < lanes; ++i) {
      const double r = at(begin + i);
      index[i] = r > reach[i] ? begin : index[i];
      reach[i] = r > reach[i] ? r : reach[i];
    }
  return best_of_lanes(reach, index);
}

std::uint64_t far_plain(const ShapeCore& hull, double x, double y, double z, double least,
                        int begin, int end) {
  std::uint64_t bits = 0;
  for (int i = begin; i < end; ++i)
    if (hull.x[i] * x + hull.y[i] * y + hull.z[i] * z >= least)
      bits |= std::uint64_t{1} << (i - begin);
  return bits;
}

#ifdef MINKRAY_HULL_SCAN_AVX2
[[gnu::target("avx2")]] std::uint64_t far_avx2(const ShapeCore& hull, double x, double y, double z,
                                               double least, int begin, int end) {
  const __m256d X = _mm256_set1_pd(x), Y = _mm256_set1_pd(y), Z = _mm256_set1_pd(z),
                limit = _mm256_set1_pd(least);
  std::uint64_t bits = 0;
  for (int i = begin; i < end; i += 4) {
    const __m256d r = _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(_mm256_loadu_pd(hull.x + i), X),
                                                  _mm256_mul_pd(_mm256_loadu_pd(hull.y + i), Y)),
                                    _mm256_mul_pd(_mm256_loadu_pd(hull.z + i), Z));
    const int four = _mm256_movemask_pd(_mm256_cmp_pd(r, limit, _CMP_GE_OQ));
    bits |= static_cast<std::uint64_t>(four) << (i - begin);
  }
  return bits;
}

[[gnu::target("avx2")]] int scan_avx2(const ShapeCore& hull, double x, double y, double z) {
  const __m256d X = _mm256_set1_pd(x), Y = _mm256_set1_pd(y), Z = _mm256_set1_pd(z);
  const double *px = hull.x, *py = hull.y, *pz = hull.z;
  __m256d best[2], index[2] = {_mm256_setzero_pd(), _mm256_setzero_pd()};
  for (int half = 0; half < 2; ++half)
    best[half] = _mm256_add_pd(_mm256_mul_pd(X, _mm256_loadu_pd(px + 4 * half)),
                               _mm256_add_pd(_mm256_mul_pd(Y, _mm256_loadu_pd(py + 4 * half)),
                                             _mm256_mul_pd(Z, _mm256_loadu_pd(pz + 4 * half))));
  for (int begin = lanes; begin < hull.count; begin += lanes) {
    const __m256d number = _mm256_set1_pd(begin);
    for (int half = 0; half < 2; ++half) {
      const int i = begin + 4 * half;
      const __m256d r = _mm256_add_pd(_mm256_mul_pd(X, _mm256_loadu_pd(px + i)),
                                      _mm256_add_pd(_mm256_mul_pd(Y, _mm256_loadu_pd(py + i)),
                                                    _mm256_mul_pd(Z, _mm256_loadu_pd(pz + i))));
      index[half] = _mm256_blendv_pd(index[half], number, _mm256_cmp_pd(r, best[half], _CMP_GT_OQ));
      best[half] = _mm256_max_pd(r, best[half]);
    }
  }
  // Returns the same lane as best_of_lanes: the first lane with the maximum.
  __m256d most = _mm256_max_pd(best[0], best[1]);
  most = _mm256_max_pd(most, _mm256_permute2f128_pd(most, most, 1));
  most = _mm256_max_pd(most, _mm256_permute_pd(most, 5));
  const int first = _mm256_movemask_pd(_mm256_cmp_pd(best[0], most, _CMP_EQ_OQ)),
            second = _mm256_movemask_pd(_mm256_cmp_pd(best[1], most, _CMP_EQ_OQ));
  const unsigned mask = static_cast<unsigned>(first | second << 4);
  if (mask == 0) return 0;  // all are NaN
  alignas(32) double at[lanes];
  for (int half = 0; half < 2; ++half) _mm256_store_pd(at + 4 * half, index[half]);
  const int lane = __builtin_ctz(mask);
  return static_cast<int>(at[lane]) + lane;
}
#endif

}  // namespace

int furthest_of_hull(const ShapeCore& hull, double x, double y, double z) {
#ifdef MINKRAY_HULL_SCAN_AVX2
  if (has_avx2()) return scan_avx2(hull, x, y, z);
#endif
  return scan(hull, x, y, z);
}

std::uint64_t far_of_hull(const ShapeCore& hull, double x, double y, double z, double least,
                          int begin) {
  const int end = std::min(hull.count, begin + 64);
#ifdef MINKRAY_HULL_SCAN_AVX2
  if (has_avx2()) return far_avx2(hull, x, y, z, least, begin, end);
#endif
  return far_plain(hull, x, y, z, least, begin, end);
}

}  // namespace minkray
