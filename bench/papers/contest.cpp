// SPDX-License-Identifier: MIT
#include "bench/papers/contest.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>

namespace minkray::bench {

std::vector<Query> make_queries() {
  std::mt19937 engine(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto direction = [&] {
    return Vec3<double>(normal(engine), normal(engine), normal(engine)).normalized();
  };
  const auto turn = [&] {
    return rotation_matrix(normal(engine), normal(engine), normal(engine), normal(engine));
  };
  std::vector<Query> list;
  for (int i = 0; i < queries; ++i) {
    const Vec3<double> where = direction() * (1 + 3 * uniform(engine));
    list.push_back({{turn(), Vec3<double>::Zero()},
                    {turn(), where},
                    Vec3<double>(-2 * where + 0.7 * direction())});
  }
  return list;
}

void race(std::vector<Contestant>& contestants, const std::vector<Query>& list) {
  for (int round = 0; round < rounds; ++round)
    for (Contestant& contestant : contestants) {
      const std::clock_t start = std::clock();  // processor time: other load does not count
      for (std::size_t i = 0; i < list.size(); ++i) contestant.answers[i] = contestant.ask(list[i]);
      contestant.seconds =
          std::min(contestant.seconds, double(std::clock() - start) / CLOCKS_PER_SEC);
    }
}

void print(const std::string& what, const std::vector<Contestant>& contestants) {
  std::printf("\n%s\n  %-34s %10s %12s %12s %8s %8s\n", what.c_str(), "", "ns/query", "mean error",
              "worst error", "wrong", "verdict");
  const Answers& reference = contestants.front().answers;
  for (const Contestant& contestant : contestants) {
    double sum = 0, worst = 0;
    int count = 0, off = 0, verdicts = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const bool has = !std::isnan(contestant.answers[i]), should = !std::isnan(reference[i]);
      verdicts += has != should;
      if (!has || !should) continue;
      const double error = std::abs(contestant.answers[i] - reference[i]);
      sum += error;
      worst = std::max(worst, error);
      off += error > wrong;
      ++count;
    }
    std::printf("  %-34s %10.0f %12.1e %12.1e %8d %8d\n", contestant.name.c_str(),
                1e9 * contestant.seconds / queries, count ? sum / count : 0.0, worst, off,
                verdicts);
  }
}

}  // namespace minkray::bench
