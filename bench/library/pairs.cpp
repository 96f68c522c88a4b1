// SPDX-License-Identifier: MIT
#include "pairs.h"

#include "random.h"

namespace bench {

std::vector<Pair> all_pairs() {
  const BulletBody ball = bullet_sphere(0.5), brick = bullet_box({1, 0.5, 0.25}),
                   pill = bullet_capsule(0.25, 0.75),
                   stone = bullet_hull(random_points(64, {1, 1, 1}, 7));
  return {{"sphere, sphere", ball, ball, 5, 3},
          {"box, box", brick, brick, 3.5, 5},
          {"capsule, capsule", pill, pill, 5, 4},
          {"hull 64, hull 64", stone, stone, 4.5, 3},
          {"cylinder, cone", bullet_cylinder(0.5, 0.75), bullet_cone(0.5, 0.75), 2, 2}};
}

std::vector<Meeting> meetings(const Pair& pair, std::size_t count, bool apart) {
  Random random(11);
  const double size = pair.a.ours.radius + pair.b.ours.radius;
  std::vector<Meeting> all;
  while (all.size() < count) {
    const double far = apart ? random.within(0.6, 2) : random.within(0, 0.6);
    const Vec where = far * size * random.direction();
    const Meeting meeting{mk::pose({}, random.rotation()), mk::pose(where, random.rotation()),
                          -2 * where + 0.7 * random.direction()};
    const mk::Distance found =
        mk::signed_distance(pair.a.ours.shape, meeting.a, pair.b.ours.shape, meeting.b);
    constexpr double least = 1e-3;
    if (apart ? found.lower > least * size : found.upper < -least * size) all.push_back(meeting);
  }
  return all;
}

}  // namespace bench
