// SPDX-License-Identifier: MIT
// The points of a hull that are far along a direction, compared with each point by itself.
#include "core/pair/hull_scan.h"

#include <gtest/gtest.h>

#include "core/pair/contact_shape.h"
#include "tests/core/pair_distance/random_bodies.h"

namespace minkray {
namespace {

TEST(HullScan, finds_all_points_that_are_far_enough) {
  testing::RandomShapes random(17);
  for (const int count : {4, 12, 64, 65, 200}) {
    const ContactShape shape(random.hull(count, 1));
    const ShapeCore& hull = shape.core();
    for (int k = 0; k < 200; ++k) {
      const Vec3<double> d = random.direction();
      const auto height = [&](int i) {
        return hull.x[i] * d.x() + hull.y[i] * d.y() + hull.z[i] * d.z();
      };
      // The height of a point is one that is just far enough.
      const double least = height(k % hull.count);
      for (int begin = 0; begin < hull.count; begin += 64) {
        const std::uint64_t far = far_of_hull(hull, d.x(), d.y(), d.z(), least, begin);
        for (int i = 0; i < 64; ++i) {
          const bool expected = begin + i < hull.count && height(begin + i) >= least;
          ASSERT_EQ((far >> i & 1) != 0, expected) << count << ", " << k << ", " << begin + i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace minkray
