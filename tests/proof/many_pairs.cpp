// SPDX-License-Identifier: MIT
// Many random pairs of all kinds of shapes, slender ones among them: their signed distances, judged
// by planes and points (tests/core/pair_distance/pair_judge.h). Prints what is wrong.
#include <cstdio>
#include <cstdlib>

#include "tests/core/pair_distance/pair_judge.h"

int main(int count, char** words) {
  using namespace minkray;
  using namespace minkray::testing;
  const long pairs = count > 1 ? std::atol(words[1]) : 1000000;
  RandomShapes random(count > 2 ? static_cast<unsigned>(std::atol(words[2])) : 1);
  long wrong = 0, statuses[4] = {};
  for (long n = 0; n < pairs; ++n) {
    const int i = static_cast<int>(n % kinds_of_bodies),
              j = static_cast<int>(n / kinds_of_bodies % kinds_of_bodies),
              k = static_cast<int>(n / kinds_of_bodies / kinds_of_bodies % 120);
    const bool is_slender = n % 11 == 10;
    const RandomPair pair = is_slender ? slender_pair(k, std::pow(10, random.in(1, 4)), random)
                                       : random_pair(i, j, k, random);
    const SignedDistance result = signed_distance(pair.a, pair.b);
    const std::string bad = complaint(pair.a, pair.b, result, random);
    ++statuses[static_cast<int>(result.status)];
    if (bad.empty()) continue;
    if (++wrong <= 50) std::printf("pair %ld, kinds %d and %d, %d: %s\n", n, i, j, k, bad.c_str());
  }
  std::printf("%ld pairs: %ld apart, %ld touching, %ld overlapping, %ld undecided; %ld wrong\n",
              pairs, statuses[0], statuses[1], statuses[2], statuses[3], wrong);
  return wrong > 0 ? 1 : 0;
}
