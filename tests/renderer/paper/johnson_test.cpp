// SPDX-License-Identifier: MIT
// Johnson's subalgorithm where its determinants round: the backup procedure.
#include <gtest/gtest.h>

#include "renderer/paper/johnson.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

using V = Vec3<double>;

// The backup procedure answered for all simplices, or with nothing, and only time was lost.
TEST(Johnson, asks_for_backup_for_vertices_in_line_alone_and_gets_a_point_of_them) {
  Random random(3);
  const auto closest = [&](double thickness) {
    JohnsonSubalgorithm<double, 3> simplex;
    simplex.begin(V::Zero());
    const V middle = 2 * random.direction(), along = random.direction();
    for (int i = 0; i < 4; ++i)
      simplex.add(middle + random.uniform(-1, 1) * along + thickness * random.in_cube());
    return simplex.closest();
  };
  int backups = 0;
  for (int i = 0; i < 5000; ++i) {
    EXPECT_TRUE(closest(0.1).proper);
    const auto answer = closest(0);
    backups += answer.proper ? 0 : 1;
    EXPECT_GT(answer.v.norm(), 1 - 1e-12);  // the line's part is between 1 and 3 away
    EXPECT_LT(answer.v.norm(), 3);
  }
  EXPECT_GT(backups, 10);
}

}  // namespace
}  // namespace minkray::testing
