// SPDX-License-Identifier: MIT
#include "renderer/json/closest_word.h"

#include <algorithm>
#include <numeric>

namespace minkray {
namespace {

/// Longer words are not compared: they are not typing errors.
constexpr std::size_t longest_word = 64;

/// Number of letters that must be added, removed, changed or swapped with their neighbour to turn
/// one word into the other (optimal string alignment, Damerau 1964).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  std::iota(d[0].begin(), d[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> closest_word(std::string_view written,
                                        const std::vector<std::string>& names) {
  if (names.empty() || written.size() > longest_word) return std::nullopt;
  std::vector<std::size_t> distances;
  for (const std::string& name : names) distances.push_back(edit_distance(written, name));
  const auto least = std::ranges::min_element(distances);
  const std::string& closest = names[static_cast<std::size_t>(least - distances.begin())];
  // A third of the letters may be wrong.
  if (*least * 3 > std::max<std::size_t>(closest.size(), 3)) return std::nullopt;
  return closest;
}

}  // namespace minkray
