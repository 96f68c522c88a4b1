// SPDX-License-Identifier: MIT
// Objects of a scene that are equally near, or touched at the same time: the derivative of the
// least is ambiguous. Compared with closed forms of balls, planes and boxes.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <cmath>
#include <vector>

namespace {

namespace mk = minkray;

/// A ball of radius 0.5 that moves along z between two such balls at x = -0.6 and 0.6: it touches
/// both once it is 0.8 before them.
class BetweenBalls : public ::testing::Test {
 protected:
  BetweenBalls() {
    left_ = scene_.add(mk::sphere(0.5), mk::translation({-0.6, 0, 3}));
    right_ = scene_.add(mk::sphere(0.5), mk::translation({0.6, 0, 3}));
    scene_.commit();
  }

  static constexpr double first_time = 3 - 0.8;

  mk::SceneImpact impact_at(double x, std::uint32_t mask = 0) {
    mk::NearOptions options;
    options.derivatives = true;
    options.errors = {&error_, 1};
    options.mask = mask;
    const mk::Shape shape = mk::sphere(0.5);
    const mk::Pose pose = mk::translation({x, 0, 0});
    const mk::Twist up = {{0, 0, 1}, {}};
    const double t_max = 9;
    mk::SceneImpact impact;
    scene_.times_of_impact({{&shape, 1}, {&pose, 1}, {&up, 1}}, {&t_max, 1}, {&impact, 1}, options);
    return impact;
  }

  mk::Scene scene_;
  std::uint32_t left_ = 0, right_ = 0;
  mk::DerivativeError error_ = {};
};

TEST_F(BetweenBalls, a_contact_with_both_at_once_is_a_ridge) {
  const mk::SceneImpact both = impact_at(0);
  EXPECT_NEAR(both.impact.t_lo, first_time, 1e-9);
  EXPECT_NE(both.is_ridge, 0);
  EXPECT_TRUE(std::isinf(error_.velocity));
  // One of the two derivatives.
  EXPECT_NEAR(std::abs(both.by_shape.velocity.x), 0.75, 1e-6);
  EXPECT_NEAR(both.by_shape.velocity.z, -1, 1e-6);
}

TEST_F(BetweenBalls, a_contact_with_one_of_them_is_none) {
  for (const double x : {-1e-3, -1e-7, 1e-7, 1e-3}) {
    const mk::SceneImpact one = impact_at(x);
    EXPECT_EQ(one.object, x < 0 ? left_ : right_) << x;
    EXPECT_EQ(one.is_ridge, 0) << x;
    const double aside = 0.6 - std::abs(x), ahead = std::sqrt(1 - aside * aside);
    EXPECT_NEAR(one.impact.t_lo, 3 - ahead, 1e-9) << x;
    EXPECT_NEAR(one.by_shape.velocity.x, std::copysign(aside / ahead, -x), 1e-7) << x;
    EXPECT_LT(error_.velocity, 1e-6) << x;
  }
}

TEST_F(BetweenBalls, an_object_outside_of_the_mask_does_not_count) {
  scene_.set_masks(left_, 2, ~0u);
  scene_.commit();
  const mk::SceneImpact one = impact_at(0, 1);
  EXPECT_EQ(one.object, right_);
  EXPECT_EQ(one.is_ridge, 0);
  EXPECT_NEAR(one.by_shape.velocity.x, -0.75, 1e-7);
  EXPECT_NE(impact_at(0).is_ridge, 0);
}

TEST_F(BetweenBalls, distances_to_both_are_ridges_if_they_are_equal) {
  const auto distance = [&](double x, mk::PairDerivativeError& error) {
    mk::NearOptions options;
    options.derivatives = true;
    options.pair_errors = {&error, 1};
    const mk::Shape shape = mk::sphere(0.25);
    const mk::Pose pose = mk::translation({x, 0, 3});
    mk::ScenePair pair;
    scene_.distance_to({{&shape, 1}, {&pose, 1}, {}}, {&pair, 1}, options);
    return pair;
  };
  mk::PairDerivativeError error = {};
  const mk::ScenePair both = distance(0, error);
  EXPECT_NEAR(both.distance.value, 0.6 - 0.75, 1e-12);  // overlapping
  EXPECT_NE(both.is_ridge, 0);
  EXPECT_TRUE(std::isinf(error.a.velocity));
  for (const double x : {-0.1, -1e-7, 1e-7, 0.1}) {
    const mk::ScenePair one = distance(x, error);
    EXPECT_EQ(one.object_b, x < 0 ? left_ : right_) << x;
    EXPECT_EQ(one.is_ridge, 0) << x;
    EXPECT_NEAR(one.by_a.velocity.x, std::copysign(1, -x), 1e-9) << x;
  }
}

TEST_F(BetweenBalls, of_several_nearest_those_that_are_equally_near_are_ridges) {
  const std::uint32_t third = scene_.add(mk::sphere(0.5), mk::translation({0, 2, 3}));
  scene_.commit();
  const std::vector<mk::Vec3> points = {{0, 0, 3}, {0.1, 0, 3}};
  mk::NearOptions options;
  options.derivatives = true;
  for (const std::size_t k : {1u, 2u, 3u}) {
    const mk::ScenePairs pairs = scene_.nearest(points, k, options);
    for (std::size_t i = 0; i < k; ++i) {
      EXPECT_EQ(pairs[i].is_ridge != 0, i < 2) << k << " " << i;
      EXPECT_EQ(pairs[k + i].is_ridge, 0) << k << " " << i;
    }
    EXPECT_TRUE(k < 3 || pairs[k - 1].object_b == third);
  }
}

/// A ball of radius 1 falls askew into the corner of a floor (a half-space, or a box) and a wall.
TEST(EquallyNear, contacts_with_a_wall_and_a_floor_at_once_are_ridges) {
  for (const bool is_half_space : {false, true}) {
    mk::Scene scene;
    if (is_half_space)
      scene.add_half_space({0, 0, 1}, 0);
    else
      scene.add(mk::box({20, 20, 1}), mk::translation({0, 0, -1}));
    scene.add(mk::box({1, 20, 20}), mk::translation({9, 0, 0}));
    scene.commit();
    const auto impact = [&](double x) {
      mk::NearOptions options;
      options.derivatives = true;
      const mk::Shape shape = mk::sphere(1);
      const mk::Pose pose = mk::translation({x, 0, 4});
      const mk::Twist askew = {{1, 0, -1}, {}};
      const double t_max = 9;
      mk::SceneImpact found;
      scene.times_of_impact({{&shape, 1}, {&pose, 1}, {&askew, 1}}, {&t_max, 1}, {&found, 1},
                            options);
      return found;
    };
    // The wall is at x = 8: both are touched at time 3.
    const mk::SceneImpact both = impact(4);
    EXPECT_NEAR(both.impact.t_lo, 3, 1e-9);
    EXPECT_NE(both.is_ridge, 0) << is_half_space;
    const mk::SceneImpact floor = impact(3.9), wall = impact(4.1);
    EXPECT_EQ(floor.is_ridge, 0) << is_half_space;
    EXPECT_EQ(wall.is_ridge, 0) << is_half_space;
    EXPECT_EQ(floor.object, 0u);
    EXPECT_EQ(wall.object, 1u);
    EXPECT_NEAR(floor.by_shape.velocity.z, 1, 1e-9);
    EXPECT_NEAR(wall.by_shape.velocity.x, -1, 1e-9);
  }
}

}  // namespace
