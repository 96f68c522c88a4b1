// SPDX-License-Identifier: MIT
// Bounds over all directions, of boxes and cylinders whose distance or depth is known.
#include "core/pair_distance/direction_bounds.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/pair/contact_shape.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

/// Both are as they are defined, the second is moved to a place.
struct KnownPair {
  Shape a, b;
  Vec3<double> place;
  double distance;  ///< less the depth

  CoreDistance bounded(const DirectionSearch& search) const {
    const ContactShape ready_a{a}, ready_b{b};
    const Affine<double> pose_a, pose_b{shifted_by(place)};
    return bound_by_directions(pair_of(ready_a, pose_a, pose_a.linear, ready_b, pose_b), {},
                               search);
  }
};

std::vector<KnownPair> known_pairs() {
  const Shape cube = Box{{1, 1, 1}}, cylinder = Cylinder{1, 1};
  return {
      {cube, cube, {1.5, 0.25, 0.125}, -0.5},        {cube, cube, {3, 0.25, 0.125}, 1},
      {cube, cube, {1.99, 0.25, 0.125}, -0.01},      {cube, cube, {2.01, 0.25, 0.125}, 0.01},
      {cube, cube, {3, 4, 0.125}, std::sqrt(5)},     {cylinder, cube, {0.25, 0.125, 1.75}, -0.25},
      {cylinder, cylinder, {3, 0, 3}, std::sqrt(2)}, {cylinder, cylinder, {1.5, 0, 0.5}, -0.5}};
}

TEST(DirectionBounds, are_around_distances_and_depths_and_as_near_as_asked) {
  for (const KnownPair& pair : known_pairs()) {
    const CoreDistance found = pair.bounded({});
    EXPECT_LE(found.lower, pair.distance + 1e-14);
    EXPECT_GE(found.upper, pair.distance - 1e-14);
    EXPECT_LE(found.upper - found.lower, 1e-9);
    EXPECT_FALSE(found.is_exhausted);
    EXPECT_EQ(found.status, pair.distance > 0 ? CoreStatus::separated : CoreStatus::overlapping);
    EXPECT_NEAR(found.axis.norm(), 1, 1e-14);
  }
}

TEST(DirectionBounds, end_with_the_sign_where_that_is_all_that_is_asked) {
  DirectionSearch search;
  search.only_sign = true;
  for (const KnownPair& pair : known_pairs()) {
    const CoreDistance found = pair.bounded(search);
    EXPECT_EQ(found.status, pair.distance > 0 ? CoreStatus::separated : CoreStatus::overlapping);
    EXPECT_FALSE(found.is_exhausted);
    EXPECT_LT(found.supports, pair.bounded({}).supports);
  }
}

TEST(DirectionBounds, hold_where_cells_become_too_small_to_be_halved) {
  DirectionSearch search;
  search.gap = 0;
  for (const KnownPair& pair : known_pairs()) {
    const CoreDistance found = pair.bounded(search);
    EXPECT_LE(found.lower, pair.distance + 1e-14);
    EXPECT_GE(found.upper, pair.distance - 1e-14);
    EXPECT_LE(found.upper - found.lower, 1e-13);
    EXPECT_LE(found.supports, 4000);
  }
}

}  // namespace
}  // namespace minkray
