// SPDX-License-Identifier: MIT
#include "agreement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bench {
namespace {

/// Surfaces are met at an angle: one hit in a hundred at a tenth of a right one, or flatter, where
/// a ray arrives ten times the error later.
constexpr double most_errors = 10;

}  // namespace

Agreement compare(const std::vector<Answer>& ours, const std::vector<Answer>& other,
                  const Trust& trust) {
  std::size_t hits = 0, one = 0, another = 0;
  std::vector<double> gaps;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const bool a = ours[i].object != nothing, b = other[i].object != nothing;
    hits += a;
    if (a != b)
      ++one;
    else if (a && ours[i].object != other[i].object)
      ++another;
    else if (a)
      gaps.push_back(std::abs(ours[i].t - other[i].t));
  }
  double gap = 0;
  if (!gaps.empty()) {
    const auto at = gaps.end() - 1 - static_cast<std::ptrdiff_t>(gaps.size() / 100);
    std::nth_element(gaps.begin(), at, gaps.end());
    gap = *at;
  }
  const auto rays = static_cast<double>(std::max<std::size_t>(ours.size(), 1));
  const double different = static_cast<double>(one + another) / rays;
  Agreement agreement;
  agreement.holds =
      hits > 0 && different <= trust.most_different && gap <= most_errors * trust.error;
  char text[96];
  std::snprintf(text, sizeof text, "%.0f %% hit, %.1e differ, dt %.0e",
                100 * static_cast<double>(hits) / rays, different, gap);
  agreement.text = text;
  return agreement;
}

void Hash::add(const void* data, std::size_t bytes) {
  const auto* at = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < bytes; ++i) state_ = (state_ ^ at[i]) * 0x100000001b3u;
}

}  // namespace bench
