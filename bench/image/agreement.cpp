// SPDX-License-Identifier: MIT
#include "bench/image/agreement.h"

#include <algorithm>
#include <cmath>

namespace minkray::bench {

Agreement compare(std::span<const FirstHit> reference, std::span<const FirstHit> other) {
  Agreement agreement;
  agreement.rays = reference.size();
  std::vector<double> gaps;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const FirstHit &a = reference[i], &b = other[i];
    agreement.hits += a.found() ? 1 : 0;
    if (a.found() != b.found())
      ++agreement.only_one;
    else if (a.instance != b.instance)
      ++agreement.other_instance;
    else if (a.found())
      gaps.push_back(std::abs(static_cast<double>(a.t) - static_cast<double>(b.t)));
  }
  if (gaps.empty()) return agreement;
  std::sort(gaps.begin(), gaps.end());
  agreement.typical = gaps[gaps.size() / 2];
  agreement.most_of_all = gaps[gaps.size() - 1 - gaps.size() / 100];
  return agreement;
}

}  // namespace minkray::bench
