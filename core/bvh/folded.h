// SPDX-License-Identifier: MIT
// Sums (of any kind) over long ranges, on several threads.
#pragma once

#include <algorithm>
#include <vector>

#include "core/parallel/parallel.h"

namespace minkray {

/// fold(result, i) for all i of [begin, end) into results of parts, whose bounds do not depend on
/// the number of threads; join(result, part) in the order of the parts.
template <class Result, class Fold, class Join>
Result folded(std::size_t begin, std::size_t end, const Fold& fold, const Join& join) {
  constexpr std::size_t part_size = 8192;  // tens of microseconds of work
  Result result;
  if (end - begin < 2 * part_size) {
    for (std::size_t i = begin; i < end; ++i) fold(result, i);
    return result;
  }
  std::vector<Result> parts((end - begin + part_size - 1) / part_size);
  for_parts(parts.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t part = first; part < last; ++part) {
      const std::size_t from = begin + part * part_size;
      for (std::size_t i = from; i < std::min(from + part_size, end); ++i) fold(parts[part], i);
    }
  });
  for (const Result& part : parts) join(result, part);
  return result;
}

}  // namespace minkray
