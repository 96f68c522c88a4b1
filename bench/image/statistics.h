// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

namespace minkray::bench {

/// There must be at least one value; of two in the middle it is the upper one.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace minkray::bench
