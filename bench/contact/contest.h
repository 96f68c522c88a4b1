// SPDX-License-Identifier: MIT
// Libraries that answer the same questions about a pair of shapes, in turn.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace minkray::bench {

/// Result of a contestant that has none.
inline constexpr double no_answer = std::numeric_limits<double>::quiet_NaN();

struct Contestant {
  std::string name;
  std::function<double(std::size_t)> ask;  ///< the query's number
  std::vector<double> answers = {};
  double nanoseconds = std::numeric_limits<double>::infinity();  ///< a query, of the best round
};

/// Runs all of them, round after round, so that a noisy moment hits all. Processor time counts.
void race(std::vector<Contestant>& contestants, std::size_t queries, int rounds);

/// Errors of results against the proven ones.
struct Errors {
  double worst = 0;
  int wrong =
      0;  ///< further off than 1e-3, or there is one and none was due, or the other way round
};
Errors errors(const std::vector<double>& answers, const std::vector<double>& proven);

}  // namespace minkray::bench
