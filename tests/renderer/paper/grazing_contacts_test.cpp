// SPDX-License-Identifier: MIT
// Contacts of two shapes that only just meet: the two points of the contact are one.
#include <gtest/gtest.h>

#include "renderer/paper/shape_cast.h"
#include "tests/core/pair_distance/pair_judge.h"
#include "tests/support/random.h"
#include "tests/support/sample_shapes.h"

namespace minkray {
namespace {

using V = Vec3<double>;
using testing::Random;
using testing::sample_shapes;
using testing::SampleShape;

/// Moves b past a at random, nearer and nearer to where they no longer touch, and returns how far
/// apart the points of the contacts are at worst, in sizes.
double worst_contact(const CentredShape& a, const CentredShape& b, Random& random, int& hits) {
  const double size = a.radius + b.radius;
  const V from = random.direction(), aside = random.direction().cross(from).normalized();
  const V centre = random.uniform(1, 4) * size * from;
  PreparedPair pair(a, b);
  pair.place(V::Zero(), centre);
  double worst = 0, meets = 0, passes = 3 * size;
  for (int i = 0; i < 50; ++i) {
    const double middle = (meets + passes) / 2;
    const auto result = cast_shape(pair, middle * aside - centre);
    const bool is_hit = result.cast.status == Status::hit;
    (is_hit ? meets : passes) = middle;
    if (!is_hit) continue;
    ++hits;
    worst = std::max(worst, (result.point_a - result.point_b).norm() / size);
  }
  return worst;
}

TEST(GrazingContacts, are_one_point_of_both_shapes) {
  Random random(7);
  std::vector<std::pair<std::string, CentredShape>> shapes;
  for (const SampleShape& sample : sample_shapes())
    shapes.emplace_back(sample.name, centred(sample.shape, {random.rotation(), V::Zero()}));
  int hits = 0;
  for (const auto& [name, a] : shapes) {
    // These have curved patches between flat ones, where the distance query ended early.
    if (!name.starts_with("minkowski_sum of three")) continue;
    for (const auto& [other, b] : shapes)
      for (int i = 0; i < 5; ++i) {
        // As near as the tolerance of the signed distance, and rounding.
        EXPECT_LT(worst_contact(a, b, random, hits), 2e-10) << name << " and " << other;
        EXPECT_LT(worst_contact(b, a, random, hits), 2e-10) << other << " and " << name;
      }
  }
  EXPECT_GT(hits, 5000);
}

// Polytopes that grow around an origin so near to their surface end with faces that rounding has
// put on it or beyond it, about one pair in a hundred.
TEST(GrazingContacts, that_overlap_by_little_more_than_rounding_are_as_deep_as_asked) {
  testing::RandomShapes random(71);
  constexpr int kinds = testing::kinds_of_bodies;
  int overlapping = 0, exhausted = 0;
  for (int k = 0; k < 3 * kinds * kinds; ++k) {
    auto [a, b] = testing::random_pair(k % kinds, k / kinds % kinds, 0, random);
    if (k % 2 == 1) b.pose.linear = a.pose.linear;
    const double size = testing::size_of(a, b);
    testing::bring_near(a, b, -std::pow(10, random.in(-14, -9)), size);
    SignedDistanceOptions options;
    options.tolerance = 1e-14;
    options.max_supports = 2000;
    const SignedDistance found = signed_distance(a, b, options);
    exhausted += found.is_exhausted;
    if (found.is_exhausted) continue;
    ASSERT_EQ(testing::complaint(a, b, found, random), "") << k;
    if (found.status != SignedStatus::overlapping) continue;
    ++overlapping;
    ASSERT_LE(found.upper - found.lower, 1e-13 * size) << k;
  }
  EXPECT_GT(overlapping, 500);
  EXPECT_LT(exhausted, 100);
}

}  // namespace
}  // namespace minkray
