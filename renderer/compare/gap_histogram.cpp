// SPDX-License-Identifier: MIT
#include "renderer/compare/gap_histogram.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace minkray {

void GapHistogram::add(double gap) {
  ++count_;
  least_ = std::min(least_, gap);
  greatest_ = std::max(greatest_, gap);
  // |gap| in [10^(k - decades), 10^(k + 1 - decades)) is k + 1 bins away from the middle.
  const double size = std::abs(gap);
  int bin = decades;
  if (size > 0) {
    const int away =
        std::clamp(static_cast<int>(std::floor(std::log10(size))) + decades + 1, 0, decades);
    bin += gap < 0 ? -away : away;
  }
  ++counts_[static_cast<std::size_t>(bin)];
}

double GapHistogram::lower_edge(int bin) {
  if (bin == 0) return -std::numeric_limits<double>::infinity();
  return bin > decades ? std::pow(10, bin - 1 - 2 * decades) : -std::pow(10, -bin);
}

double GapHistogram::upper_edge(int bin) {
  return -lower_edge(bins - 1 - bin);
}

double GapHistogram::quantile(double share) const {
  std::int64_t below = 0;
  for (int bin = 0; bin < bins; ++bin) {
    below += in_bin(bin);
    if (static_cast<double>(below) >= share * static_cast<double>(count_))
      return std::min(greatest_, upper_edge(bin));
  }
  return greatest_;
}

std::string GapHistogram::text() const {
  std::string lines;
  for (int bin = 0; bin < bins; ++bin) {
    if (in_bin(bin) == 0) continue;
    const double share = static_cast<double>(in_bin(bin)) / static_cast<double>(count_);
    char line[120];
    std::snprintf(line, sizeof line, "  %9.0e .. %9.0e %10lld  ", lower_edge(bin), upper_edge(bin),
                  static_cast<long long>(in_bin(bin)));
    lines += line + std::string(static_cast<std::size_t>(std::ceil(50 * share)), '#') + "\n";
  }
  return lines;
}

}  // namespace minkray
