// SPDX-License-Identifier: MIT
// Derivatives of many random pairs compared with central differences in long double
// (tests/core/pair_derivative/derivative_judge.h): a row for each kind of shape. Prints errors.
#include <cstdio>
#include <cstdlib>

#include "tests/core/pair_derivative/derivative_judge.h"

namespace {

using namespace minkray;
using namespace minkray::testing;

struct Row {
  long pairs = 0, smooth = 0, flagged = 0, needless = 0, missed = 0, unsure = 0, large = 0,
       outside = 0, bounded = 0, not_global = 0;
  double error = 0, log_bound = 0;

  void add(const JudgedDerivative& judged) {
    ++pairs;
    if (!judged.is_known) {
      ++unsure;
      return;
    }
    flagged += judged.is_flagged ? 1 : 0;
    not_global += judged.is_global ? 0 : 1;
    unsure += judged.slope == Slope::unsure ? 1 : 0;
    missed += judged.slope == Slope::ridge && !judged.is_flagged ? 1 : 0;
    if (judged.slope != Slope::smooth) return;
    needless += judged.is_flagged ? 1 : 0;
    ++smooth;
    if (judged.is_flagged) return;
    large += judged.error > 1e-6 ? 1 : 0;
    outside += judged.is_within ? 0 : 1;
    bounded += std::isfinite(judged.bound) ? 1 : 0;
    if (std::isfinite(judged.bound)) log_bound += std::log10(judged.bound);
    error = std::max(error, judged.error);
  }
  void print(std::string_view name) const {
    std::printf("%-18.*s %9ld %9ld %8ld %8ld %7ld %7ld %8ld %8ld %6ld %9.1e %9ld %9.1e\n",
                static_cast<int>(name.size()), name.data(), pairs, smooth, flagged, needless,
                missed, unsure, large, outside, not_global, error, bounded,
                std::pow(10, log_bound / static_cast<double>(std::max(bounded, 1L))));
  }
};

}  // namespace

int main(int count, char** words) {
  const long pairs = count > 1 ? std::atol(words[1]) : 1000000;
  RandomShapes random(count > 2 ? static_cast<unsigned>(std::atol(words[2])) : 1);
  std::vector<Row> of_kinds(kinds_of_derived_bodies);
  Row apart, overlapping, nearly, aligned, slender, all;
  long shown = 0;
  for (long n = 0; n < pairs; ++n) {
    const int i = static_cast<int>(n % kinds_of_derived_bodies),
              j = static_cast<int>(n / kinds_of_derived_bodies % kinds_of_derived_bodies),
              k = static_cast<int>(n / kinds_of_derived_bodies / kinds_of_derived_bodies % 120);
    const bool is_aligned = n % 13 == 12, is_slender = n % 26 == 5;
    const RandomPair pair = is_aligned   ? aligned_pair(i, j, random)
                            : is_slender ? slender_pair(k, std::pow(10, random.in(1, 3)), random)
                                         : derived_pair(i, j, k, random);
    const bool is_thorough = is_aligned || n % 16 == 0;
    const JudgedDerivative judged = DerivativeJudge(pair.a, pair.b, random, is_thorough).judged();
    all.add(judged);
    if (is_aligned) {
      aligned.add(judged);
    } else if (is_slender) {
      slender.add(judged);
    } else {
      of_kinds[static_cast<std::size_t>(i)].add(judged);
      of_kinds[static_cast<std::size_t>(j)].add(judged);
      (std::abs(judged.value) < 1e-4 ? nearly : judged.value > 0 ? apart : overlapping).add(judged);
    }
    const bool is_missed = judged.slope == Slope::ridge && !judged.is_flagged;
    const bool is_needless = judged.slope == Slope::smooth && judged.is_flagged;
    const bool is_large =
        judged.slope == Slope::smooth && !judged.is_flagged && judged.error > 1e-6;
    if ((is_missed || is_needless || is_large || !judged.is_global || !judged.is_within) &&
        ++shown <= 100000)
      std::printf(
          "pair %ld, kinds %d and %d%s, %d: %s%s%s%s, value %.3g, error %.2g bound %.2g\n", n, i, j,
          is_aligned   ? ", aligned"
          : is_slender ? ", slender"
                       : "",
          k, is_missed ? "ridge not flagged" : "", is_needless ? "flagged needlessly" : "",
          is_large            ? "large error"
          : !judged.is_within ? "out of its bound"
                              : "",
          judged.is_global ? "" : "not the least depth", judged.value, judged.error, judged.bound);
  }
  std::printf("%-18s %9s %9s %8s %8s %7s %7s %8s %8s %6s %9s %9s %9s\n", "kind", "pairs", "smooth",
              "flagged", "needless", "missed", "unsure", "> 1e-6", "outside", "depth", "largest",
              "bounded", "mean");
  for (int i = 0; i < kinds_of_derived_bodies; ++i)
    of_kinds[static_cast<std::size_t>(i)].print(name_of_derived(i));
  apart.print("all apart");
  overlapping.print("all overlapping");
  nearly.print("all nearly touch");
  aligned.print("aligned on a grid");
  slender.print("slender");
  all.print("all");
  return all.missed + all.large + all.outside > 0 ? 1 : 0;
}
