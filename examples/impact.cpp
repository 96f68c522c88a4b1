// SPDX-License-Identifier: MIT
// When a tumbling brick first touches a ball: no earlier than t_lo, which is proven.
#include <minkray/minkray.h>

#include <cstdio>

namespace mk = minkray;

int main() {
  const mk::Shape brick = mk::box({0.3, 0.1, 0.2}), ball = mk::sphere(0.5);
  const mk::Twist tumbling = {{-1, 0, 0}, {0.5, 2, 1}};
  const mk::Impact impact = mk::time_of_impact(ball, mk::identity(), {}, brick,
                                               mk::translation({3, 0.2, 0}), tumbling, 5);
  if (impact.status != MINKRAY_IMPACT) return 1;
  std::printf("apart until %.9f, touching at %.9f, at (%.3f, %.3f, %.3f)\n", impact.t_lo,
              impact.t_hi, impact.point_a[0], impact.point_a[1], impact.point_a[2]);
}
