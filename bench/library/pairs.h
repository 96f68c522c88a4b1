// SPDX-License-Identifier: MIT
// The pairs of shapes of the queries, and their poses.
#pragma once

#include "bullet.h"

namespace bench {

struct Pair {
  std::string name;
  BulletBody a, b;
  double distance_goal, impact_goal;
};

/// Goals are ratios Bullet / Minkray.
std::vector<Pair> all_pairs();

/// A and B at the beginning; B moves by `motion`, and A does not.
struct Meeting {
  mk::Pose a, b;
  Vec motion;
};

/// Random turns. Apart: by a thousandth of their size at least, and by twice their size at most;
/// most of the motions meet A. Else they overlap, by a thousandth at least.
std::vector<Meeting> meetings(const Pair& pair, std::size_t count, bool apart);

}  // namespace bench
