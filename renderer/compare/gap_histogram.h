// SPDX-License-Identifier: MIT
// Histogram of the difference of two ray parameters, by sign and decade.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace minkray {

/// Gaps are lengths in units of the shape's size. A negative gap is a pair in the wrong order, by
/// rounding or by mistake.
class GapHistogram {
 public:
  /// Decades from 10^-first to 1; smaller gaps share a bin with zero.
  static constexpr int decades = 12;

  void add(double gap);

  std::int64_t count() const { return count_; }
  double least() const { return least_; }
  double greatest() const { return greatest_; }

  /// Bins from the most negative to the most positive: [-inf, -1e-1), ... (-1e-12, 1e-12), ...
  static constexpr int bins = 2 * decades + 1;
  std::int64_t in_bin(int bin) const { return counts_[static_cast<std::size_t>(bin)]; }
  /// Edges of a bin.
  static double lower_edge(int bin);
  static double upper_edge(int bin);

  /// The gap below which this share of all gaps lies, up to the width of a bin (its upper edge).
  double quantile(double share) const;

  /// One line a bin that is not empty: edges, count, a bar.
  std::string text() const;

 private:
  std::array<std::int64_t, bins> counts_ = {};
  std::int64_t count_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
  double greatest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace minkray
