// SPDX-License-Identifier: MIT
// The clearance of a small arm's paths beside dense samples of closed forms in long double, with
// kinematics of the test's own.
#include "renderer/clearance/clearance.h"

#include <gtest/gtest.h>

#include "core/contact/swept.h"
#include "renderer/clearance/swept_scene.h"
#include "tests/renderer/clearance/arm.h"

namespace minkray {
namespace {

using testing::arm_model;
using testing::distance;
using testing::Long;
using testing::RandomPath;
using testing::Rod;
using testing::rods_at;
using testing::Vector;

/// A ball beside the arm and the ground below it.
struct Around {
  Scene scene;
  Rod ball;
  Long ground;

  explicit Around(std::mt19937& engine) {
    std::uniform_real_distribution<double> in(0.6, 1.6);
    const Vec3<double> middle(in(engine), in(engine)-1, in(engine));
    ball = {{middle.cast<Long>(), middle.cast<Long>()}, 0.15L};
    ground = -1 - in(engine);
    Object one, plane;
    one.name = "ball";
    one.shape = Sphere<double>{0.15};
    one.pose.translation = middle;
    plane.name = "ground";
    plane.half_space = HalfSpaceBody<double>{{0, 0, 1}, static_cast<double>(ground)};
    scene.objects = {one, plane};
  }
  /// To the arm, and of the arm's links that no joint connects.
  Long least(const std::array<Rod, 4>& rods) const {
    Long best = std::min(
        {distance(rods[0], rods[2]), distance(rods[0], rods[3]), distance(rods[1], rods[3])});
    for (std::size_t i = 1; i < 4; ++i) {
      best = std::min(best, distance(rods[i], ball));
      for (const Vector& end : rods[i].ends)
        best = std::min(best, end.z() - rods[i].radius - ground);
    }
    return best;
  }
};

TEST(Clearance, is_below_ten_thousand_samples_and_at_most_five_percent) {
  std::mt19937 engine(2);
  const Model model = arm_model();
  int clear = 0, colliding = 0;
  for (int k = 0; k < 60; ++k) {
    const RandomPath random(engine);
    const Around around(engine);
    std::vector<ClearanceBody> bodies = bodies_of(model, GeometryChoice::collision);
    ASSERT_EQ(bodies.size(), 4u);
    for (const ClearanceBody& body : bodies_of(around.scene)) bodies.push_back(body);
    // The base stands still, and so do the obstacles.
    const std::vector<BodyPair> pairs = pairs_of(bodies, model, {}, true);
    ASSERT_EQ(pairs.size(), 3u + 6u);
    ClearanceOptions options;
    options.every_step = k % 2 == 1;
    const Clearance found = clearance_of(JointPath(model, random.rows), bodies, pairs, options);
    ASSERT_TRUE(found.closest.is_settled) << k;
    Long least = 1e30L;
    for (int i = 0; i <= 10000; ++i)
      least = std::min(least, around.least(random.at(1.5L * i / 10000)));
    ASSERT_LE(found.closest.lower, least) << k;
    ASSERT_LE(least - found.closest.lower, 0.05L * std::abs(least) + 1e-6L) << k;
    ASSERT_NEAR(static_cast<double>(around.least(random.at(found.closest.time))),
                found.closest.upper, 1e-9)
        << k;
    (least > 0 ? clear : colliding) += 1;
    ASSERT_EQ(found.steps.size(), options.every_step ? 3u : 0u);
    for (std::size_t step = 0; step < found.steps.size(); ++step) {
      Long of_step = 1e30L;
      for (int i = 0; i <= 2000; ++i)
        of_step = std::min(of_step,
                           around.least(random.at(0.5L * (static_cast<Long>(step) + i / 2000.0L))));
      ASSERT_LE(found.steps[step].lower, of_step) << k;
      ASSERT_LE(of_step - found.steps[step].lower, 0.05L * std::abs(of_step) + 1e-6L) << k;
    }
  }
  EXPECT_GT(clear, 10);
  EXPECT_GT(colliding, 10);
}

TEST(Clearance, a_single_row_is_a_robot_that_stands_still) {
  const Model model = arm_model();
  const std::vector<ClearanceBody> bodies = bodies_of(model, GeometryChoice::collision);
  const std::vector<BodyPair> pairs = pairs_of(bodies, model, {}, true);
  const JointPath path(model, {{3, {{"elbow", {1.0}}}}});
  const Clearance found = clearance_of(path, bodies, pairs, {});
  const std::array<Rod, 4> rods = rods_at(0, 1, 0);
  const Long least = std::min(
      {distance(rods[0], rods[2]), distance(rods[0], rods[3]), distance(rods[1], rods[3])});
  EXPECT_NEAR(found.closest.upper, static_cast<double>(least), 1e-12);
  EXPECT_LE(found.closest.lower, least);
  EXPECT_GE(found.closest.lower, least - 1e-12L);
  EXPECT_EQ(found.closest.time, 3);
}

/// A chain with a joint of every kind.
Model chain_of_all_joints() {
  Model model;
  const JointKind kinds[] = {JointKind::free,  JointKind::hinge,  JointKind::slide,
                             JointKind::ball,  JointKind::planar, JointKind::hinge,
                             JointKind::fixed, JointKind::slide};
  for (int i = 0; i < 8; ++i) {
    ModelLink link;
    link.name = "link" + std::to_string(i);
    link.parent = i - 1;
    link.rest = {rotation_matrix(0.1 * i, 0.2, -0.1, 1.0), {0.3, 0.1 * i, -0.2}};
    ModelJoint joint;
    joint.name = "joint" + std::to_string(i);
    joint.kind = kinds[i];
    joint.axis = Vec3<double>(1, 0.5 * i, -1).normalized();
    joint.anchor = {0.1, -0.2, 0.05 * i};
    joint.reference = 0.1;
    link.joints.push_back(joint);
    model.links.push_back(link);
  }
  return model;
}

std::vector<JointRow> random_rows(const Model& model, std::mt19937& engine) {
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<JointRow> rows(2);
  for (JointRow& row : rows)
    for (const ModelLink& link : model.links)
      for (const ModelJoint& joint : link.joints) {
        std::vector<double> values;
        for (std::size_t i = 0; i < width_of(joint.kind); ++i) values.push_back(number(engine));
        if (!values.empty()) row.values.push_back({joint.name, values});
      }
  rows[1].time = 1;
  return rows;
}

TEST(Clearance, no_point_is_faster_or_more_crooked_than_its_bound) {
  std::mt19937 engine(4);
  std::normal_distribution<double> normal;
  const Model model = chain_of_all_joints();
  for (int k = 0; k < 40; ++k) {
    const JointPath path(model, random_rows(model, engine));
    StepMotion motion(path, 0);
    for (int link = 0; link < 8; ++link)
      for (int ancestor = -1; ancestor <= link; ++ancestor) {
        const double reach = 0.4;
        const MotionBound bound = motion.bound(link, ancestor, reach);
        const Vec3<double> p =
            reach * Vec3<double>(normal(engine), normal(engine), normal(engine)).normalized();
        constexpr double h = 1e-3;
        const double s = 0.1 + 0.02 * k;
        const auto at = [&](double time) -> Vec3<double> {
          const std::vector<Affine<double>>& links = motion.links_at(time);
          const Vec3<double> world = links[static_cast<std::size_t>(link)](p);
          if (ancestor < 0) return world;
          const Affine<double>& frame = links[static_cast<std::size_t>(ancestor)];
          return frame.linear.transpose() * (world - frame.translation);
        };
        const Vec3<double> before = at(s - h), here = at(s), after = at(s + h);
        ASSERT_LE(here.norm(), bound.reach + 1e-12);
        ASSERT_LE((after - before).norm() / (2 * h), bound.speed + 1e-9);
        ASSERT_LE((after - 2 * here + before).norm() / (h * h), bound.acceleration + 1e-8)
            << link << " as " << ancestor << " sees it";
      }
  }
}

TEST(Clearance, the_bound_of_one_hinge_is_what_a_point_at_its_reach_does) {
  const Model model = arm_model();
  const JointPath path(model, {{0, {{"elbow", {0.0}}}}, {1, {{"elbow", {1.5}}}}});
  StepMotion motion(path, 0);
  const MotionBound bound = motion.bound(2, 1, 0.7);
  EXPECT_NEAR(bound.speed, 1.5 * 0.7, 1e-9);
  EXPECT_NEAR(bound.acceleration, 1.5 * 1.5 * 0.7, 1e-9);
  EXPECT_EQ(motion.bound(1, 0, 0.7).speed, 0);
  EXPECT_EQ(motion.common_ancestor(3, 1), 1);
}

TEST(Clearance, a_million_points_of_the_links_lie_in_the_swept_bodies) {
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> in(0, 1);
  const auto direction = [&] {
    return Vec3<double>(normal(engine), normal(engine), normal(engine)).normalized();
  };
  const Model model = arm_model();
  std::size_t points = 0;
  double largest = 0;
  for (int k = 0; k < 4; ++k) {
    const RandomPath random(engine);
    const JointPath path(model, random.rows);
    for (std::size_t step = 0; step < path.steps(); ++step)
      for (const ModelGeom& geom : model.geoms) {
        if (geom.link <= 0) continue;
        StepMotion motion(path, step);
        const ContactShape ball(*geom.shape, geom.pose);
        const MotionBound bound =
            motion.bound(geom.link, -1, ball.middle().norm() + ball.ball_radius());
        constexpr int parts = 8;
        const auto pose = [&](double s) {
          return motion.links_at(s)[static_cast<std::size_t>(geom.link)] * geom.pose;
        };
        for (int part = 0; part < parts; ++part) {
          const double begin = part / double(parts), end = (part + 1) / double(parts);
          const Affine<double> from = pose(begin), to = pose(end);
          const Shape<double> body =
              swept(*geom.shape, from, to, bound.acceleration / (parts * parts));
          for (int i = 0; i < 140; ++i) {
            const double s = in(engine);
            const Affine<double> there = pose(begin + s * (end - begin));
            for (int j = 0; j < 25; ++j) {
              const Vec3<double> p = geom.shape->support(direction());
              const Vec3<double> point = there(p);
              Vec3<double> away = point - ((1 - s) * from(p) + s * to(p));
              if (!(away.norm() > 0)) away = direction();
              away.normalize();
              for (const Vec3<double>& n : {away, direction()})
                largest = std::max(largest, n.dot(point - body.support(n)));
              ++points;
            }
          }
        }
      }
  }
  EXPECT_GE(points, 1000000u);
  EXPECT_LE(largest, 1e-13);
}

TEST(Clearance, a_swept_scene_has_a_body_for_each_part_of_a_step_and_stands_still_once) {
  const Model model = arm_model();
  ImportOptions import;
  import.geometry = GeometryChoice::collision;
  Mistakes mistakes("arm.urdf");
  const JointPath path(model, {{0, {{"elbow", {0.0}}}}, {1, {{"elbow", {1.0}}}}});
  const Scene scene = swept_scene(model, import, path, {}, mistakes);
  EXPECT_TRUE(mistakes.none());
  // Base and upper arm stand still.
  std::size_t whole = 0, swept_ones = 0;
  for (const Object& object : scene.objects)
    (object.name.find(" step ") == std::string::npos ? whole : swept_ones) += 1;
  EXPECT_EQ(whole, 2u);
  EXPECT_GT(swept_ones, 4u);
  EXPECT_LE(swept_ones, 128u);
}

TEST(Clearance, links_that_may_touch_are_left_out) {
  const Model model = arm_model();
  const std::vector<ClearanceBody> bodies = bodies_of(model, GeometryChoice::collision);
  AllowedPairs allowed;
  EXPECT_EQ(pairs_of(bodies, model, allowed, true).size(), 3u);
  allowed.allow("hand", "base");
  EXPECT_EQ(pairs_of(bodies, model, allowed, true).size(), 2u);
  EXPECT_EQ(pairs_of(bodies, model, allowed, false).size(), 0u);
}

}  // namespace
}  // namespace minkray
