// SPDX-License-Identifier: MIT
// How far a link that swings stays from an obstacle at least, proven at each pose.
#include <minkray/minkray.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mk = minkray;

int main() {
  const mk::Shape link = mk::translated(mk::capsule(0.05, 0.4), {0, 0, 0.4});
  const mk::Shape obstacle = mk::rounded(mk::box({0.2, 0.2, 0.2}), 0.02);
  double least = 1e9;
  for (int i = 0; i <= 90; i += 5) {
    const double half = 0.5 * i * 3.14159265358979323846 / 180;
    const mk::Pose swing = mk::pose({0, 0, 0}, {0, std::sin(half), 0, std::cos(half)});
    const mk::Distance d =
        mk::signed_distance(link, swing, obstacle, mk::translation({0.9, 0, 0.9}));
    least = std::min(least, d.lower);
    if (i % 30 == 0) std::printf("%2d degrees: %.12f to %.12f\n", i, d.lower, d.upper);
  }
  std::printf("never nearer than %.12f\n", least);
  return least > 0 ? 0 : 1;
}
