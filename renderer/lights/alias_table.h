// SPDX-License-Identifier: MIT
// Drawing one of many in proportion to weights, in constant time (Walker 1974, built as by Vose,
// "A Linear Algorithm for Generating Random Numbers with a Given Distribution", 1991).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace minkray {

class AliasTable {
 public:
  /// Weights are finite and >= 0; if all are zero each is as likely as the others.
  explicit AliasTable(std::span<const double> weights);

  /// Draws an index by a number u in [0, 1).
  std::size_t draw(double u) const;
  /// The chance of one of them.
  double chance(std::size_t i) const { return chances_[i]; }

 private:
  struct Column {
    double own;           ///< the part of the column that is its own
    std::uint32_t other;  ///< outcome that has the rest
  };
  std::vector<Column> columns_;
  std::vector<double> chances_;
};

}  // namespace minkray
