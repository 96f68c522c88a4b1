// SPDX-License-Identifier: MIT
// Compares near pairs by the hierarchy with all pairs.
#include "core/world/near_pairs.h"

#include <gtest/gtest.h>

#include "tests/core/pair_distance/random_bodies.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using testing::kinds_of_bodies;
using testing::random_shape;
using testing::RandomShapes;

std::vector<ContactBody> scattered(int count, double room, RandomShapes& random) {
  std::vector<ContactBody> bodies;
  for (int i = 0; i < count; ++i) {
    const double size = std::pow(10, random.in(-1.5, 0));
    bodies.push_back(
        {ContactShape(random_shape(i % kinds_of_bodies, size, random)),
         {random.turn(), Vec3<double>(random.in(0, room), random.in(0, room), random.in(0, room))},
         1u << (i % 3),
         i % 7 == 0 ? 2u : 7u});
  }
  return bodies;
}

std::vector<NearPair> all_pairs(const std::vector<ContactBody>& a,
                                const std::vector<ContactBody>& b, bool is_self, double at_most) {
  std::vector<NearPair> pairs;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = is_self ? i + 1 : 0; j < b.size(); ++j) {
      if (!((a[i].category & b[j].mask) && (b[j].category & a[i].mask))) continue;
      const SignedDistance found = signed_distance(a[i].shape, a[i].pose, b[j].shape, b[j].pose);
      if (found.lower <= at_most) pairs.push_back({i, j, found});
    }
  return pairs;
}

void expect_same(const std::vector<NearPair>& found, const std::vector<NearPair>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].a, expected[i].a);
    ASSERT_EQ(found[i].b, expected[i].b);
    ASSERT_EQ(found[i].distance.value, expected[i].distance.value);
  }
}

TEST(NearPairs, are_those_that_a_look_at_all_pairs_finds) {
  RandomShapes random(3);
  std::size_t seen = 0;
  for (const double at_most : {0.0, 0.05, 0.5}) {
    const std::vector<ContactBody> bodies = scattered(300, 6, random),
                                   others = scattered(100, 6, random);
    const ContactWorld world(bodies), other(others);
    NearPairsOptions options;
    options.at_most = at_most;
    const auto expected = all_pairs(bodies, bodies, true, at_most);
    expect_same(near_pairs(world, options), expected);
    expect_same(near_pairs(world, other, options), all_pairs(bodies, others, false, at_most));
    seen += expected.size();
    // Excluded pairs.
    options.wanted = [](std::size_t a, std::size_t b) { return (a + b) % 2 == 0; };
    for (const NearPair& pair : near_pairs(world, options)) ASSERT_EQ((pair.a + pair.b) % 2, 0u);
  }
  EXPECT_GT(seen, 100u);
}

TEST(NearPairs, a_world_of_one_body_or_none_has_no_pairs) {
  RandomShapes random(4);
  EXPECT_TRUE(near_pairs(ContactWorld({}), {}).empty());
  EXPECT_TRUE(near_pairs(ContactWorld(scattered(1, 1, random)), {}).empty());
  EXPECT_TRUE(nearest_bodies(scattered(1, 1, random)[0], ContactWorld({}), 3).empty());
}

TEST(NearPairs, the_nearest_bodies_are_those_of_a_look_at_all) {
  RandomShapes random(5);
  const std::vector<ContactBody> bodies = scattered(400, 8, random);
  const ContactWorld world(bodies);
  for (const ContactBody& to : scattered(60, 8, random)) {
    std::vector<double> values;
    for (const ContactBody& body : bodies)
      if (to.is_pair_with(body))
        values.push_back(signed_distance(to.shape, to.pose, body.shape, body.pose).value);
    std::ranges::sort(values);
    const std::vector<NearPair> found = nearest_bodies(to, world, 5);
    ASSERT_EQ(found.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) ASSERT_EQ(found[i].distance.value, values[i]);
  }
}

/// A distance that did not converge has the value 0: the ball at 1e200 was nearest, and with it
/// nothing else was searched.
TEST(NearPairs, what_is_at_an_unknown_distance_is_not_the_nearest) {
  const auto ball_at = [](double x) {
    return ContactBody{ContactShape(Shape(Sphere{1})), shifted_by(x, 0, 0)};
  };
  for (const bool is_first : {true, false}) {
    std::vector<ContactBody> bodies = {ball_at(5), ball_at(9)};
    bodies.insert(is_first ? bodies.begin() : bodies.end(), ball_at(1e200));
    const std::size_t unknown = is_first ? 0 : 2, nearest = is_first ? 1 : 0;
    const ContactWorld world(bodies);
    for (const std::size_t count : {1u, 2u, 3u, 4u}) {
      const std::vector<NearPair> found = nearest_bodies(ball_at(0), world, count);
      ASSERT_EQ(found.size(), std::min<std::size_t>(count, 3));
      EXPECT_NEAR(found[0].distance.value, 3, 1e-12);
      const std::size_t order[] = {nearest, nearest + 1, unknown};
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].b, order[i]) << i;
    }
    // The one at 1e200 is alone there.
    const std::vector<NearPair> far = nearest_bodies(ball_at(-1e200), world, 1);
    ASSERT_EQ(far.size(), 1u);
    EXPECT_TRUE(far[0].distance.is_unknown());
  }
  // An infinite body may be near.
  const ContactBody infinite{ContactShape(Shape(Sphere{std::numeric_limits<double>::infinity()})),
                             {}};
  const ContactWorld world({infinite, ball_at(9)});
  EXPECT_EQ(nearest_bodies(ball_at(0), world, 1).at(0).b, 1u);
  EXPECT_EQ(near_pairs(world, {}).size(), 1u);
}

}  // namespace
}  // namespace minkray
