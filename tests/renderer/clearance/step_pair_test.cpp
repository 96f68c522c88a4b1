// SPDX-License-Identifier: MIT
// Pairs of a small arm's bodies at moments of a step, compared with closed forms in long double.
#include "renderer/clearance/step_pair.h"

#include <gtest/gtest.h>

#include "renderer/verify/step_pairs.h"
#include "tests/renderer/clearance/arm.h"

namespace minkray {
namespace {

using testing::distance;
using testing::Long;
using testing::RandomPath;
using testing::Rod;
using testing::Vector;

constexpr double ground = -0.4;

/// The arm's four bodies, a ball and the ground.
class Arm {
 public:
  explicit Arm(std::mt19937& engine)
      : random_(engine),
        path_(model_, random_.rows),
        bodies_(bodies_of(model_, GeometryChoice::collision)) {
    Scene scene;
    Object ball, plane;
    ball.shape = Sphere{0.15};
    ball.pose.translation = {0.8, 0.7, 0.9};
    plane.half_space = HalfSpaceBody<double>{{0, 0, 1}, ground};
    scene.objects = {ball, plane};
    for (const ClearanceBody& body : bodies_of(scene)) bodies_.push_back(body);
  }
  static constexpr std::size_t ball = 4, plane = 5;

  const std::vector<ClearanceBody>& bodies() const { return bodies_; }
  const JointPath& path() const { return path_; }

  /// Distance by closed forms, in the first step.
  Long distance_at(std::size_t a, std::size_t b, double s) const {
    const std::array<Rod, 4> rods = random_.at(0.5L * s);
    const auto rod = [&](std::size_t i) {
      return i < 4 ? rods[i] : Rod{{Vector(0.8L, 0.7L, 0.9L), Vector(0.8L, 0.7L, 0.9L)}, 0.15L};
    };
    if (a == plane) std::swap(a, b);
    if (b != plane) return distance(rod(a), rod(b));
    return std::min(rod(a).ends[0].z(), rod(a).ends[1].z()) - rod(a).radius - Long(ground);
  }

 private:
  RandomPath random_;
  Model model_ = testing::arm_model();
  JointPath path_;
  std::vector<ClearanceBody> bodies_;
};

TEST(StepPair, has_the_distances_of_closed_forms) {
  std::mt19937 engine(5);
  int in_frame_of_link = 0, overlapping = 0, apart = 0;
  for (int k = 0; k < 40; ++k) {
    const Arm arm(engine);
    StepMotion motion(arm.path(), 0);
    StepPairs pairs(arm.path(), arm.bodies(), 0);
    for (std::size_t a = 0; a < arm.bodies().size(); ++a)
      for (std::size_t b = 0; b < arm.bodies().size(); ++b) {
        if (a == b || (a >= Arm::ball && b >= Arm::ball)) continue;
        const ClearanceBody &body_a = arm.bodies()[a], &body_b = arm.bodies()[b];
        const StepBound bound = step_bound(body_a, body_b, motion);
        in_frame_of_link += bound.frame >= 0;
        EXPECT_TRUE(bound.is_within_numbers);
        const Long at_begin = arm.distance_at(a, b, 0);
        for (const double s : {0.0, 0.25, 0.5, 1.0}) {
          const StepMoment moment(body_a, place_of(body_a, motion, s), body_b,
                                  place_of(body_b, motion, s), bound, motion, s);
          const SignedDistance found = moment.distance({});
          const Long exact = arm.distance_at(a, b, s);
          (exact > 0 ? apart : overlapping) += 1;
          EXPECT_LE(std::abs(exact - at_begin), bound.speed * s + 1e-12)
              << a << ' ' << b << ' ' << s;
          // Depths of capsules whose axes cross are more than by the nearest points of the axes.
          if (exact < 0 && a < Arm::ball && b < Arm::ball) {
            EXPECT_LT(found.value, 0) << a << ' ' << b << ' ' << s;
            continue;
          }
          EXPECT_NEAR(found.value, double(exact), 1e-9) << a << ' ' << b << ' ' << s;
          EXPECT_LE(found.lower, exact);
          EXPECT_GE(found.upper, exact);

          // Nearest points in the world are that far from each other along the normal.
          const SignedDistance world = moment.in_world(found);
          EXPECT_NEAR(world.normal.dot(world.point_b - world.point_a), found.value, 1e-9);
          if (a == Arm::plane) {
            EXPECT_NEAR(world.point_a.z(), ground, 1e-9);
          }
          if (b == Arm::plane) {
            EXPECT_NEAR(world.point_b.z(), ground, 1e-9);
          }
          if (a == Arm::ball && exact > 0) {
            EXPECT_NEAR((world.point_a - Vec3<double>(0.8, 0.7, 0.9)).norm(), 0.15, 1e-9);
          }

          // The gap is the distance along the normal, and less along any other direction.
          EXPECT_NEAR(moment.gap(found.normal), found.value, 1e-9);
          EXPECT_LE(moment.gap(Vec3<double>(0.6, 0, 0.8)), double(exact) + 1e-12);

          // The referee's moments are these.
          const SignedDistance kept = pairs.at({a, b}, pairs.bound({a, b}), s, 1e9);
          EXPECT_EQ(kept.value, found.value);
          EXPECT_EQ(kept.normal, found.normal);
          EXPECT_EQ(kept.point_a, found.point_a);
        }
      }
  }
  EXPECT_GT(in_frame_of_link, 100);
  EXPECT_GT(overlapping, 100);
  EXPECT_GT(apart, 100);
}

TEST(StepPair, of_swapped_bodies_is_the_same_seen_from_the_other) {
  std::mt19937 engine(6);
  const Arm arm(engine);
  StepMotion motion(arm.path(), 0);
  for (std::size_t a = 0; a < Arm::ball; ++a)
    for (std::size_t b = a + 1; b < arm.bodies().size(); ++b) {
      const auto at = [&](std::size_t i, std::size_t j) {
        const ClearanceBody &one = arm.bodies()[i], &other = arm.bodies()[j];
        const StepMoment moment(one, place_of(one, motion, 0.3), other,
                                place_of(other, motion, 0.3), step_bound(one, other, motion),
                                motion, 0.3);
        return moment.in_world(moment.distance({}));
      };
      const SignedDistance forth = at(a, b), back = at(b, a);
      EXPECT_NEAR(forth.value, back.value, 1e-12);
      EXPECT_LT((forth.normal + back.normal).norm(), 1e-6);
      if (forth.value < 0) continue;
      EXPECT_LT((forth.point_a - back.point_b).norm(), 1e-6);
      EXPECT_LT((forth.point_b - back.point_a).norm(), 1e-6);
    }
}

}  // namespace
}  // namespace minkray
