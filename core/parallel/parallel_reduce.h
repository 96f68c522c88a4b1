// SPDX-License-Identifier: MIT
// Reduces long ranges on several threads and joins the parts in order, so results have the same
// bits for any number of threads.
#pragma once

#include <algorithm>
#include <vector>

#include "core/parallel/parallel.h"

namespace minkray {

/// Splits [begin, end) into ranges that do not depend on the number of threads. Calls fold(result,
/// i) for all i of a range, and join(result, of_range) in the order of the ranges.
template <class Result, class Fold, class Join>
Result parallel_reduce(std::size_t begin, std::size_t end, const Fold& fold, const Join& join) {
  constexpr std::size_t range_size = 8192;  // tens of microseconds of work
  Result result;
  if (end - begin < 2 * range_size) {
    for (std::size_t i = begin; i < end; ++i) fold(result, i);
    return result;
  }
  std::vector<Result> of_ranges((end - begin + range_size - 1) / range_size);
  parallel_for(of_ranges.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t range = first; range < last; ++range) {
      const std::size_t from = begin + range * range_size;
      for (std::size_t i = from; i < std::min(from + range_size, end); ++i)
        fold(of_ranges[range], i);
    }
  });
  for (const Result& of_range : of_ranges) join(result, of_range);
  return result;
}

}  // namespace minkray
