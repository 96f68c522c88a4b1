// SPDX-License-Identifier: MIT
#include "bench/contact/contest.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace minkray::bench {

void race(std::vector<Contestant>& contestants, std::size_t queries, int rounds) {
  for (Contestant& contestant : contestants) contestant.answers.assign(queries, no_answer);
  for (int round = 0; round < rounds; ++round)
    for (Contestant& contestant : contestants) {
      const std::clock_t start = std::clock();
      for (std::size_t i = 0; i < queries; ++i) contestant.answers[i] = contestant.ask(i);
      const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      contestant.nanoseconds =
          std::min(contestant.nanoseconds, 1e9 * seconds / static_cast<double>(queries));
    }
}

Errors errors(const std::vector<double>& answers, const std::vector<double>& proven) {
  constexpr double wrong = 1e-3;
  Errors all;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const bool has = !std::isnan(answers[i]), should = !std::isnan(proven[i]);
    const double off = has && should ? std::abs(answers[i] - proven[i]) : 0;
    all.worst = std::max(all.worst, off);
    if (has != should || off > wrong) ++all.wrong;
  }
  return all;
}

}  // namespace minkray::bench
