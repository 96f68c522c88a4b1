// SPDX-License-Identifier: MIT
#include "renderer/lights/alias_table.h"

#include <algorithm>
#include <numeric>

namespace minkray {

AliasTable::AliasTable(std::span<const double> weights)
    : columns_(weights.size()), chances_(weights.size()) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto count = static_cast<double>(weights.size());
  std::vector<double> heights(weights.size());
  std::vector<std::uint32_t> low, high;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    chances_[i] = sum > 0 ? weights[i] / sum : 1 / count;
    heights[i] = chances_[i] * count;
    columns_[i] = {1, static_cast<std::uint32_t>(i)};
    (heights[i] < 1 ? low : high).push_back(static_cast<std::uint32_t>(i));
  }
  // Columns that are too low are filled up from one that is too high.
  while (!low.empty() && !high.empty()) {
    const std::uint32_t filled = low.back(), giver = high.back();
    low.pop_back();
    columns_[filled] = {heights[filled], giver};
    heights[giver] -= 1 - heights[filled];
    if (heights[giver] < 1) {
      high.pop_back();
      low.push_back(giver);
    }
  }
}

std::size_t AliasTable::draw(double u) const {
  const double at = u * static_cast<double>(columns_.size());
  const std::size_t i = std::min(static_cast<std::size_t>(at), columns_.size() - 1);
  return at - static_cast<double>(i) < columns_[i].own ? i : columns_[i].other;
}

}  // namespace minkray
