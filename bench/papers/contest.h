// SPDX-License-Identifier: MIT
// Libraries that answer the same queries in turn: time and error side by side. The reference for
// errors is the first contestant.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/math/affine.h"

namespace minkray::bench {

inline constexpr int queries = 2000, rounds = 5;
/// Answers this far off, in sizes of the shapes, are counted as wrong.
inline constexpr double wrong = 1e-3;

struct Query {
  Affine<double> a, b;
  Vec3<double> motion;  ///< of b
};

std::vector<Query> make_queries();

/// A number for each query; NaN for "no answer".
using Answers = std::vector<double>;
inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Contestant {
  std::string name;
  std::function<double(const Query&)> ask;
  Answers answers = Answers(queries);
  double seconds = std::numeric_limits<double>::infinity();
};

/// Runs all of them, round after round; the best round counts.
void race(std::vector<Contestant>& contestants, const std::vector<Query>& list);

void print(const std::string& what, const std::vector<Contestant>& contestants);

}  // namespace minkray::bench
