// SPDX-License-Identifier: MIT
// Compares the clearance of a small arm's paths with dense samples of closed forms in long double,
// with kinematics of the test's own.
#include "renderer/clearance/clearance.h"

#include <gtest/gtest.h>

#include "core/pair_motion/swept.h"
#include "renderer/base/errors.h"
#include "renderer/clearance/swept_scene.h"
#include "tests/renderer/clearance/arm.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

using testing::arm_model;
using testing::distance;
using testing::Long;
using testing::RandomPath;
using testing::Rod;
using testing::rods_at;

/// A ball next to the arm and the ground below it.
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
    one.shape = Sphere{0.15};
    one.pose.translation = middle;
    plane.name = "ground";
    plane.half_space = HalfSpaceBody<double>{{0, 0, 1}, static_cast<double>(ground)};
    scene.objects = {one, plane};
  }
  /// To the arm, and of the arm's links that no joint connects.
  Long least(const std::array<Rod, 4>& rods) const {
    return std::min({distance(rods[0], rods[2]), distance(rods[0], rods[3]),
                     distance(rods[1], rods[3]), testing::distance_to_arm(rods, ball, ground)});
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
    // The base is fixed, and so are the obstacles.
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
          const Shape body = swept(*geom.shape, from, to, bound.acceleration / (parts * parts));
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
  // Base and upper arm are at rest.
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

/// A robot's paths were "clear" with particles in their way.
TEST(Clearance, particles_are_obstacles_as_objects_are) {
  const Model model = arm_model();
  const JointPath path(model, {{0, {{"elbow", {0.0}}}}, {1, {{"elbow", {1.5}}}}});
  Object ball;
  ball.name = "ball";
  ball.shape = Sphere{0.5};
  ball.pose.translation = {0.2, -1.2, 1.6};
  Scene with_objects, with_particles;
  with_objects.objects = {ball};
  ParticleSet grains;
  grains.name = "grains";
  grains.shape = Sphere{0.25};
  grains.materials = {0};
  grains.scale_numbers = 1;
  grains.poses = {9, 9, 9, 1, 0.2, -1.2, 1.6, 2};
  with_particles.particles = {grains};
  Clearance found[2];
  for (const Scene* scene : {&with_objects, &with_particles}) {
    std::vector<ClearanceBody> bodies = bodies_of(model, GeometryChoice::collision);
    for (const ClearanceBody& body : bodies_of(*scene)) bodies.push_back(body);
    const std::vector<BodyPair> pairs = pairs_of(bodies, model, {}, false);
    Clearance& one = found[scene == &with_particles];
    one = clearance_of(path, bodies, pairs, {});
    if (scene == &with_particles) {
      ASSERT_EQ(bodies.size(), 6u);
      EXPECT_EQ(bodies[one.closest.b].name, "grains[1]");
    }
  }
  EXPECT_LT(found[0].closest.upper, 0);
  EXPECT_EQ(found[0].closest.lower, found[1].closest.lower);
  EXPECT_EQ(found[0].closest.upper, found[1].closest.upper);
}

/// The clearance was "proven" to be 2.9 for rows of quaternions 1e200 times as long: the squares
/// of their numbers are out of range, so the arm was assumed at rest while it passes the ball.
TEST(Clearance, quaternions_turn_alike_whatever_their_length) {
  Model model;
  ModelLink link;
  link.name = "arm";
  link.joints.push_back({.name = "ball", .kind = JointKind::ball});
  model.links = {link};
  ModelGeom rod;
  rod.link = 0;
  rod.kind = "capsule";
  rod.shape = Shape(Capsule{0.1, 2.5});
  rod.pose = {rotation_matrix(0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)), {2.5, 0, 0}};
  model.geoms = {rod};
  Scene scene;
  Object ball;
  ball.shape = Sphere{1};
  ball.pose.translation = {0, 4, 0};
  scene.objects = {ball};
  std::vector<ClearanceBody> bodies = bodies_of(model, GeometryChoice::collision);
  bodies.push_back(bodies_of(scene).front());
  const std::vector<BodyPair> pairs = pairs_of(bodies, model, {}, true);
  ASSERT_EQ(pairs.size(), 1u);
  // From along x by 170 degrees about z: half way the arm is in the ball.
  const double w = std::cos(1.48), z = std::sin(1.48);
  for (const double length : {1.0, 0.3, 7.0, 1e200, 1e-200, 1e308, 1e-320})
    for (const double first : {length, 0.0}) {  // of length zero it turns nothing
      const JointPath path(model, {{0, {{"ball", {first, 0.0, 0.0, 0.0}}}},
                                   {1, {{"ball", {length * w, 0.0, 0.0, length * z}}}}});
      const Clearance found = clearance_of(path, bodies, pairs, {});
      EXPECT_TRUE(found.closest.is_settled);
      EXPECT_NEAR(found.closest.upper, -1.1, 0.01) << length;
      EXPECT_LE(found.closest.lower, -1.1 + 1e-9) << length;
    }
}

/// Error of making a path; empty if it is accepted.
std::string refusal(const std::vector<JointRow>& rows) {
  return message_of<BadInput>([&] { JointPath(arm_model(), rows); });
}

/// The way between such rows is infinite, which became 2^63 parts of a sweep.
TEST(Clearance, rows_that_nobody_can_go_between_are_refused) {
  EXPECT_EQ(refusal({{0, {{"elbow", {-1e308}}}}, {1, {{"elbow", {1e308}}}}}),
            "path: row 2 of 2: the joint \"elbow\" must not change by more than the range of "
            "double in one step (-1e+308 to 1e+308)");
  EXPECT_EQ(refusal({{0, {{"elbow", {1e308}}}}, {1, {{"elbow", {1.1e308}}}}}), "");
  EXPECT_TRUE(
      has(refusal({{0, {{"wrist", {std::numeric_limits<double>::infinity()}}}}}), "finite"));
  // The joint was assumed at rest through the first step, and at its given value from there on.
  EXPECT_TRUE(has(refusal({{0, {{"elbow", {0.0}}}}, {1, {{"elbow", {0.0}}, {"wrist", {0.5}}}}}),
                  "row 2 of 2: the joint \"wrist\" must have a value from the first row on"));
}

/// Two slides that go as far as numbers reach, and together further.
TEST(Clearance, nothing_is_proven_of_what_goes_further_than_numbers_reach) {
  Model model;
  for (const char* name : {"one", "two"}) {
    ModelLink link;
    link.name = name;
    link.parent = static_cast<int>(model.links.size()) - 1;
    link.joints.push_back({.name = name, .kind = JointKind::slide, .axis = {1, 0, 0}});
    model.links.push_back(link);
  }
  ModelGeom ball;
  ball.name = "ball";
  ball.link = 1;
  ball.shape = Shape(Sphere{1});
  model.geoms = {ball};
  std::vector<ClearanceBody> bodies = bodies_of(model, GeometryChoice::collision);
  Scene scene;
  scene.objects.emplace_back().shape = Sphere{1};
  scene.objects[0].pose.translation = {9, 0, 0};
  bodies.push_back(bodies_of(scene).front());
  const std::vector<BodyPair> pairs = pairs_of(bodies, model, {}, true);
  ASSERT_EQ(pairs.size(), 1u);
  const JointPath path(model, {{0, {{"one", {0.0}}, {"two", {0.0}}}},
                               {1, {{"one", {1.5e308}}, {"two", {1.5e308}}}}});
  const Clearance found = clearance_of(path, bodies, pairs, {});
  EXPECT_EQ(found.closest.lower, -std::numeric_limits<double>::infinity());
  EXPECT_FALSE(found.closest.is_settled);
  Mistakes mistakes("robot");
  swept_scene(model, {}, path, {}, mistakes);
  EXPECT_EQ(mistakes.text(), "robot: step 1 of the path moves \"ball\" further than numbers reach");
}

TEST(Clearance, a_sweep_of_more_bodies_than_are_allowed_is_a_mistake_before_they_are_made) {
  ImportOptions import;
  import.geometry = GeometryChoice::collision;
  const JointPath path(arm_model(), {{0, {{"elbow", {0.0}}}}, {1, {{"elbow", {3.0}}}}});
  SweptSceneOptions options;
  options.most_bodies = 10;
  Mistakes mistakes("arm.urdf");
  const Scene scene = swept_scene(arm_model(), import, path, options, mistakes);
  EXPECT_EQ(mistakes.text(), "arm.urdf: the path sweeps more than 10 shapes");
  EXPECT_EQ(scene.objects.size(), 4u);  // the arm itself
}

/// 150 bytes of MJCF, a composite of 100,000 particles, have 5,000,000,000 pairs.
TEST(Clearance, more_pairs_than_ten_million_are_refused) {
  Model model;
  ModelLink link;
  link.joints.push_back({.name = "slide", .kind = JointKind::slide});
  model.links.assign(100'000, link);
  const ContactShape ball(Shape(Sphere{1}));
  std::vector<ClearanceBody> bodies;
  for (int i = 0; i < 100'000; ++i) bodies.push_back({"ball", "link", i, ball});
  EXPECT_THROW(pairs_of(bodies, model, {}, true), BadInput);
  EXPECT_TRUE(pairs_of(bodies, model, {}, false).empty());
  Scene scene;
  ParticleSet grains;
  grains.materials = {0};
  grains.poses.assign(3 * (most_obstacles + 1), 0.0);
  scene.particles = {grains};
  EXPECT_THROW(bodies_of(scene), BadInput);
}

}  // namespace
}  // namespace minkray
