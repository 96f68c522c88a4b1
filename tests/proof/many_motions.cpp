// SPDX-License-Identifier: MIT
// Compares the first contacts in many random motions of bodies that move and turn with dense
// sampling and bisection in long double (tests/core/pair_motion/moving_pairs.h). Prints errors.
#include <cstdio>
#include <cstdlib>

#include "tests/core/pair_motion/moving_pairs.h"

int main(int count, char** words) {
  using namespace minkray::testing;
  const long motions = count > 1 ? std::atol(words[1]) : 100000;
  const int samples = count > 2 ? std::atoi(words[2]) : 500;
  RandomNumbers random(count > 3 ? static_cast<unsigned>(std::atol(words[3])) : 1);
  SeenImpacts seen;
  long wrong = 0;
  for (long n = 0; n < motions; ++n) {
    const bool are_boxes = n % 2 == 1;
    const MovingPair pair = are_boxes ? moving_boxes(random) : moving_capsules(random);
    const std::string bad = impact_complaint(pair, samples, seen);
    if (bad.empty()) continue;
    if (++wrong <= 50)
      std::printf("%s %ld: %s\n", are_boxes ? "boxes" : "capsules", n, bad.c_str());
  }
  std::printf(
      "%ld motions, %d samples each: %d hits, %d misses, %d inside at the start; t_hi - t_lo "
      "at most %.1e; %ld wrong\n",
      motions, samples, seen.hits, seen.misses, seen.inside, seen.width, wrong);
  return wrong > 0 ? 1 : 0;
}
