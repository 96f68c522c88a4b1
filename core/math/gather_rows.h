// SPDX-License-Identifier: MIT
// Reads rows of a table of numbers, one row per lane. Loads full registers and transposes them,
// which is faster than inserting single numbers into lanes.
#pragma once

#include "core/math/wide.h"

namespace minkray {
namespace detail {

#if defined(__SSE2__)
/// Number of columns that a call of transpose() reads from each row.
inline constexpr std::size_t transposed_columns = 4;

#if defined(__AVX2__)
template <class W>
requires(sizeof(W) == 32) void transpose(const std::array<const double*, 4>& rows, W* columns) {
  const __m256d a = _mm256_loadu_pd(rows[0]), b = _mm256_loadu_pd(rows[1]);
  const __m256d c = _mm256_loadu_pd(rows[2]), d = _mm256_loadu_pd(rows[3]);
  const __m256d ab_even = _mm256_unpacklo_pd(a, b), ab_odd = _mm256_unpackhi_pd(a, b);
  const __m256d cd_even = _mm256_unpacklo_pd(c, d), cd_odd = _mm256_unpackhi_pd(c, d);
  using Lanes = typename W::Lanes;
  columns[0] = W(Lanes(_mm256_permute2f128_pd(ab_even, cd_even, 0x20)));
  columns[1] = W(Lanes(_mm256_permute2f128_pd(ab_odd, cd_odd, 0x20)));
  columns[2] = W(Lanes(_mm256_permute2f128_pd(ab_even, cd_even, 0x31)));
  columns[3] = W(Lanes(_mm256_permute2f128_pd(ab_odd, cd_odd, 0x31)));
}
#else
template <class W>
requires(sizeof(W) == 16) void transpose(const std::array<const double*, 2>& rows, W* columns) {
  using Lanes = typename W::Lanes;
  for (int k = 0; k < 4; k += 2) {
    const __m128d a = _mm_loadu_pd(rows[0] + k), b = _mm_loadu_pd(rows[1] + k);
    columns[k] = W(Lanes(_mm_unpacklo_pd(a, b)));
    columns[k + 1] = W(Lanes(_mm_unpackhi_pd(a, b)));
  }
}
#endif
#else
inline constexpr std::size_t transposed_columns = 1;

template <class W>
void transpose(const std::array<const double*, LaneOf<W>::count>& rows, W* columns) {
  for (int i = 0; i < LaneOf<W>::count; ++i)
    columns[0].set_lane(i, *rows[static_cast<std::size_t>(i)]);
}
#endif

}  // namespace detail

/// Returns the first `count` numbers of the row `index`. `count` must be a multiple of 4, `index` a
/// small integer. Row 0 begins at `table`; rows are `row_size` numbers apart.
template <std::size_t count>
std::array<double, count> gather_row(double index, const double* table, std::size_t row_size) {
  std::array<double, count> columns;
  std::memcpy(columns.data(), table + static_cast<std::size_t>(index) * row_size, sizeof(columns));
  return columns;
}

/// Same, with one row per lane.
template <std::size_t count, class W>
requires(LaneOf<W>::count > 1) std::array<W, count> gather_row(const W& index, const double* table,
                                                               std::size_t row_size) {
  static_assert(count % detail::transposed_columns == 0);
  const auto row = [&](int lane) {
    return table + static_cast<std::size_t>(index.lane(lane)) * row_size;
  };
  std::array<W, count> columns;
  if (all(index == W(index.lane(0)))) {
    const double* const same = row(0);
    for (std::size_t k = 0; k < count; ++k) columns[k] = W(same[k]);
    return columns;
  }
  std::array<const double*, LaneOf<W>::count> rows;
  for (int lane = 0; lane < LaneOf<W>::count; ++lane)
    rows[static_cast<std::size_t>(lane)] = row(lane);
  for (std::size_t k = 0; k < count; k += detail::transposed_columns) {
    detail::transpose<W>(rows, columns.data() + k);
    for (const double*& at : rows) at += detail::transposed_columns;
  }
  return columns;
}

}  // namespace minkray
