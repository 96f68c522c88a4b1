// SPDX-License-Identifier: MIT
// Robots have the same clearance wherever they are: of two balls that overlap by 2e-11, 10^6 sizes
// from the world's origin, 79 of 248 were called clear, and the nearest pair was lost. A robot's
// whole surroundings are moved by a vector that doubles hold exactly.
#include "renderer/clearance/clearance.h"

#include <gtest/gtest.h>

#include "renderer/field/distance_field.h"
#include "tests/core/pair_distance/random_numbers.h"
#include "tests/renderer/clearance/arm.h"
#include "tests/support/number_of_cases.h"

namespace minkray {
namespace {

using testing::arm_model;
using testing::distance;
using testing::Long;
using testing::number_of_cases;
using testing::RandomPath;
using testing::Rod;
using testing::rods_at;
using testing::Vector;

constexpr std::array places = {0.0, 10.0, 100.0, 1e4, 1e6, 1e9};

/// With so few digits that sums with others as coarse are exact 10^9 away.
Vec3<double> coarse(const Vec3<double>& v) {
  return (v * 0x1p20).array().round().matrix() / 0x1p20;
}

struct RandomPlaces : testing::RandomNumbers {
  using RandomNumbers::RandomNumbers;
  Vec3<double> at(double distance) { return (distance * direction()).array().round().matrix(); }
};

Scene scene_of_balls(const std::vector<std::pair<Vec3<double>, double>>& balls) {
  Scene scene;
  for (const auto& [middle, radius] : balls) {
    Object& object = scene.objects.emplace_back();
    object.name = "ball";
    object.shape = Sphere{radius};
    object.pose.translation = middle;
  }
  return scene;
}

Clearance clearance_beside(const Model& model, const std::vector<JointRow>& rows,
                           const Scene& obstacles) {
  std::vector<ClearanceBody> bodies = bodies_of(model, GeometryChoice::collision);
  for (const ClearanceBody& body : bodies_of(obstacles)) bodies.push_back(body);
  return clearance_of(JointPath(model, rows), bodies, pairs_of(bodies, model, {}, false), {});
}

/// A ball on a turning link, which hangs on a fixed link.
Model turning_ball(const Vec3<double>& hinge, double arm, double radius) {
  Model model;
  ModelLink base, link;
  base.name = "base";
  link.name = "arm";
  link.parent = 0;
  link.rest.translation = hinge;
  link.joints.push_back({.name = "hinge", .kind = JointKind::hinge});
  model.links = {base, link};
  ModelGeom ball;
  ball.link = 1;
  ball.kind = "sphere";
  ball.shape = Shape(Sphere{radius});
  ball.pose.translation = {arm, 0, 0};
  model.geoms = {ball};
  return model;
}

TEST(Places, balls_that_nearly_touch_are_neither_clear_nor_colliding_without_a_proof) {
  RandomPlaces random(621);
  for (const double place : places) {
    int settled = 0;
    for (int k = 0; k < number_of_cases(500); ++k) {
      const Vec3<double> hinge = random.at(place);
      const double arm = random.in(0.2, 1), radius = random.in(0.01, 0.3),
                   angle = random.in(-20, 20);
      const Vec3<double> aside = coarse(2 * random.direction());
      const Vector middle(arm * std::cos(Long(angle)), arm * std::sin(Long(angle)), 0);
      const Long apart = (aside.cast<Long>() - middle).norm() - Long(radius);
      const double gap = (k % 2 == 0 ? 1 : -1) * std::pow(10, random.in(-17, -9));
      const double other = static_cast<double>(apart - Long(k % 5 == 0 ? 0 : gap));
      if (!(other > 0)) continue;
      const Long truth = apart - Long(other);
      const Clearance found =
          clearance_beside(turning_ball(hinge, arm, radius), {{0, {{"hinge", {angle}}}}},
                           scene_of_balls({{hinge + aside, other}}));
      ASSERT_LE(found.closest.lower, truth) << place << " " << k;
      ASSERT_GE(found.closest.upper, truth) << place << " " << k;
      ASSERT_LE(found.closest.upper - found.closest.lower, 1e-13) << place << " " << k;
      ASSERT_GT(found.closest.distance.normal.norm(), 0.5) << place << " " << k;
      settled += found.closest.lower > 0 || found.closest.upper < 0;
    }
    EXPECT_GT(settled, 200) << place;
  }
}

/// The arm and what is around it, moved.
struct RobotAround {
  Scene scene;
  Rod ball;
  Long ground;

  RobotAround(RandomPlaces& random, const Vec3<double>& way) {
    const Vec3<double> middle =
        coarse({random.in(0.6, 1.6), random.in(-0.4, 0.6), random.in(0.6, 1.6)});
    ball = {{middle.cast<Long>(), middle.cast<Long>()}, 0.15L};
    scene = scene_of_balls({{middle + way, 0.15}});
    const double height = coarse(Vec3<double>::Constant(-1 - random.in(0.6, 1.6))).x();
    ground = height;
    Object& plane = scene.objects.emplace_back();
    plane.name = "ground";
    plane.half_space = HalfSpaceBody<double>();
    plane.pose.translation = way + Vec3<double>(0, 0, height);
  }
  Long least(const std::array<Rod, 4>& rods) const {
    return testing::distance_to_arm(rods, ball, ground);
  }
};

TEST(Places, arms_have_the_clearance_that_they_have_nearby) {
  RandomPlaces random(622);
  for (const double place : places)
    for (int k = 0; k < 12; ++k) {
      const RandomPath path(random.engine());
      const Vec3<double> way = random.at(place);
      const RobotAround around(random, way);
      Model model = arm_model();
      model.links[0].rest.translation += way;
      const Clearance found = clearance_beside(model, path.rows, around.scene);
      ASSERT_TRUE(found.closest.is_settled) << place << " " << k;
      Long least = 1e30L;
      for (int i = 0; i <= 10000; ++i)
        least = std::min(least, around.least(path.at(1.5L * i / 10000)));
      ASSERT_LE(found.closest.lower, least) << place << " " << k;
      ASSERT_LE(least - found.closest.lower, 0.05L * std::abs(least) + 1e-6L) << place << " " << k;
      ASSERT_NEAR(static_cast<double>(around.least(path.at(found.closest.time))),
                  found.closest.upper, 1e-13)
          << place << " " << k;
    }
}

/// A cart that slides, or goes anywhere, far away.
TEST(Places, carts_have_the_clearance_that_they_have_nearby) {
  RandomPlaces random(623);
  for (const double place : places)
    for (int k = 0; k < number_of_cases(300); ++k) {
      const Vec3<double> way = random.at(place), from = coarse(2 * random.direction()),
                         to = coarse(2 * random.direction());
      Model model;
      ModelLink cart;
      cart.name = "cart";
      ModelGeom ball;
      ball.link = 0;
      ball.kind = "sphere";
      ball.shape = Shape(Sphere{0.25});
      model.geoms = {ball};
      std::vector<JointRow> rows;
      if (k % 2 == 0) {
        cart.joints.push_back({.name = "anywhere", .kind = JointKind::free});
        for (const Vec3<double>& at : {from, to}) {
          const Vec3<double> p = at + way;
          rows.push_back({double(rows.size()), {{"anywhere", {p.x(), p.y(), p.z(), 1, 0, 0, 0}}}});
        }
        model.links = {cart};
      } else {
        for (int axis = 0; axis < 3; ++axis) {
          const std::string name = "slide" + std::to_string(axis);
          cart.joints.push_back(
              {.name = name, .kind = JointKind::slide, .axis = Vec3<double>::Unit(axis)});
        }
        for (const Vec3<double>& at : {from, to}) {
          JointRow row{double(rows.size()), {}};
          for (int axis = 0; axis < 3; ++axis)
            row.values.push_back({"slide" + std::to_string(axis), {at[axis] + way[axis]}});
          rows.push_back(row);
        }
        model.links = {cart};
      }
      const Vec3<double> middle = coarse(3 * random.direction());
      const Clearance found = clearance_beside(model, rows, scene_of_balls({{middle + way, 0.5}}));
      const Vector a = (from - middle).cast<Long>(), e = (to - from).cast<Long>();
      const Long t = std::clamp<Long>(-a.dot(e) / e.squaredNorm(), 0, 1);
      const Long least = (a + t * e).norm() - 0.75L;
      ASSERT_LE(found.closest.lower, least) << place << " " << k;
      ASSERT_GE(found.closest.upper, least - 1e-18L) << place << " " << k;
      ASSERT_LE(found.closest.upper - least, 0.02L * std::abs(least) + 1e-6L) << place << " " << k;
    }
}

TEST(Places, fields_are_the_same) {
  RandomPlaces random(624);
  for (const double place : places) {
    const Vec3<double> way = random.at(place);
    Scene here = scene_of_balls({{{0, 0, 0}, 0.5}, {{1.5, 0.25, 0}, 0.25}}), there;
    Object box;
    box.shape = Box{{0.25, 0.5, 0.125}};
    box.pose.translation = {-1, 0.5, 0};
    Object ground;
    ground.half_space = HalfSpaceBody<double>();
    ground.pose.translation = {0, 0, -0.5};
    here.objects.push_back(box);
    here.objects.push_back(ground);
    there = here;
    for (Object& object : there.objects) object.pose.translation += way;
    const Shape probe = Sphere{0.0625};
    FieldPlane plane{16, 16, {-2, -2, 0}, {0.25, 0, 0}, {0, 0.25, 0}};
    const DistanceField near = measure_field(here, probe, plane, {});
    plane.corner += way;
    const DistanceField far = measure_field(there, probe, plane, {});
    EXPECT_EQ(near.value, far.value) << place;
    EXPECT_EQ(near.lower, far.lower) << place;
    EXPECT_EQ(near.upper, far.upper) << place;
    EXPECT_EQ(near.object, far.object) << place;
  }
}

}  // namespace
}  // namespace minkray
