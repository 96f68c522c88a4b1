// SPDX-License-Identifier: MIT
// Compares verdicts on a small arm's motions with dense samples of closed forms in long double,
// with kinematics and Hermite polynomials of the test's own.
#include "renderer/verify/referee.h"

#include <gtest/gtest.h>

#include "core/parallel/parallel.h"
#include "renderer/scene/scene.h"
#include "tests/renderer/clearance/arm.h"

namespace minkray {
namespace {

using testing::arm_model;
using testing::distance;
using testing::Long;
using testing::Rod;
using testing::rods_at;

constexpr double step_length = 0.7;  // seconds

/// Rows of the arm's three joints, with rates and accelerations if the degree needs them.
struct RandomMotion {
  int degree;
  std::vector<std::array<double, 3>> values, rates, accelerations;

  RandomMotion(std::mt19937& engine, int of_degree) : degree(of_degree) {
    std::uniform_real_distribution<double> any(-1, 1);
    for (int i = 0; i < 5; ++i) {
      values.push_back({2.2 * any(engine), 2.2 * any(engine), 0.3 * any(engine)});
      rates.push_back({2 * any(engine), 2 * any(engine), 0.4 * any(engine)});
      accelerations.push_back({5 * any(engine), 5 * any(engine), 2 * any(engine)});
    }
  }

  JointPath path(const Model& model) const {
    std::vector<JointRow> rows;
    for (std::size_t i = 0; i < values.size(); ++i)
      rows.push_back(
          {step_length * static_cast<double>(i),
           {{"shoulder", {values[i][0]}}, {"elbow", {values[i][1]}}, {"wrist", {values[i][2]}}}});
    JointPath path(model, rows);
    const auto in_order = [&](const std::vector<std::array<double, 3>>& table) {
      std::vector<std::vector<std::vector<double>>> all;
      for (const auto& row : table) {
        all.emplace_back();
        for (const ModelLink& link : model.links)
          for (const ModelJoint& joint : link.joints)
            all.back().push_back({row[joint.name == "shoulder" ? 0
                                      : joint.name == "elbow"  ? 1
                                                               : 2]});
      }
      return all;
    };
    if (degree >= 3) path.rates = in_order(rates);
    if (degree == 5) path.accelerations = in_order(accelerations);
    return path;
  }

  /// Uses Hermite's basis functions (E. Catmull's notation h00, h10, ...).
  Long joint(std::size_t j, Long time) const {
    const auto last = values.size() - 2;
    const auto i = std::min<std::size_t>(last, static_cast<std::size_t>(time / Long(step_length)));
    const Long h = Long(step_length) * (i + 1) - Long(step_length) * i;
    const Long s = (time - Long(step_length) * i) / h, s2 = s * s, s3 = s2 * s, s4 = s3 * s,
               s5 = s4 * s;
    const Long p = values[i][j], q = values[i + 1][j], u = h * rates[i][j], v = h * rates[i + 1][j],
               a = h * h * accelerations[i][j], b = h * h * accelerations[i + 1][j];
    if (degree == 1) return (1 - s) * p + s * q;
    if (degree == 3)
      return (2 * s3 - 3 * s2 + 1) * p + (s3 - 2 * s2 + s) * u + (3 * s2 - 2 * s3) * q +
             (s3 - s2) * v;
    return (1 - 10 * s3 + 15 * s4 - 6 * s5) * p + (s - 6 * s3 + 8 * s4 - 3 * s5) * u +
           (s2 - 3 * s3 + 3 * s4 - s5) / 2 * a + (s3 - 2 * s4 + s5) / 2 * b +
           (-4 * s3 + 7 * s4 - 3 * s5) * v + (10 * s3 - 15 * s4 + 6 * s5) * q;
  }
  std::array<Rod, 4> at(Long time) const {
    return rods_at(joint(0, time), joint(1, time), joint(2, time));
  }
  Long end() const { return Long(step_length) * (values.size() - 1); }
};

/// The arm, a ball next to it, and their pairs.
struct ArmAndBall {
  Model model = arm_model();
  Rod ball;
  std::vector<ClearanceBody> bodies = bodies_of(model, GeometryChoice::collision);
  std::vector<RefereePair> pairs;

  explicit ArmAndBall(std::mt19937& engine, double margin = 0) {
    std::uniform_real_distribution<double> in(-1.6, 1.6);
    const Vec3<double> middle(in(engine), in(engine), std::abs(in(engine)));
    ball = {{middle.cast<Long>(), middle.cast<Long>()}, 0.3L};
    Scene scene;
    scene.objects.resize(1);
    scene.objects[0].name = "ball";
    scene.objects[0].shape = Sphere{0.3};
    scene.objects[0].pose.translation = middle;
    bodies.push_back(bodies_of(scene)[0]);
    pairs = {{0, 2}, {0, 3}, {1, 3}, {1, 4, margin}, {2, 4, margin}, {3, 4, margin}};
  }
  Long clearance(std::size_t pair, const std::array<Rod, 4>& rods) const {
    const auto rod = [&](std::size_t body) { return body < 4 ? rods[body] : ball; };
    return distance(rod(pairs[pair].a), rod(pairs[pair].b)) - Long(pairs[pair].margin);
  }
};

/// Checks a verdict by dense samples.
void check_by_samples(const MotionVerdict& verdict, const RandomMotion& motion,
                      const ArmAndBall& cell) {
  constexpr int samples = 5000;
  constexpr double rounding = 1e-9;
  Long least = 1e30L;
  for (int i = 0; i <= samples; ++i) {
    const Long time = motion.end() * i / samples;
    const std::array<Rod, 4> rods = motion.at(time);
    for (std::size_t pair = 0; pair < cell.pairs.size(); ++pair) {
      const Long clearance = cell.clearance(pair, rods);
      least = std::min(least, clearance);
      if (clearance > -rounding) continue;
      // A moment at which they collide lies in a stretch.
      const bool is_told = std::ranges::any_of(verdict.stretches, [&](const Stretch& stretch) {
        return stretch.pair == pair && stretch.begin <= double(time) + rounding &&
               double(time) - rounding <= stretch.end;
      });
      ASSERT_TRUE(is_told) << "pair " << pair << " at " << double(time);
    }
  }
  for (const Stretch& stretch : verdict.stretches) {
    if (!stretch.collides) continue;
    ASSERT_LE(stretch.begin, stretch.time);
    ASSERT_LE(stretch.time, stretch.end);
    ASSERT_LE(double(cell.clearance(stretch.pair, motion.at(stretch.time))),
              stretch.upper + rounding);
    ASSERT_LT(stretch.upper, 0);
  }
  if (verdict.status != MotionStatus::free) return;
  ASSERT_GT(verdict.least.lower, 0);
  ASSERT_LE(verdict.least.lower, double(least) + rounding);
  ASSERT_LE(double(least), verdict.least.upper + 0.02 * verdict.least.upper + 1e-6);
  ASSERT_GE(verdict.least.lower, 0.98 * verdict.least.upper - 1e-6);
  ASSERT_NEAR(double(cell.clearance(verdict.least.pair, motion.at(verdict.least.time))),
              verdict.least.upper, rounding);
}

class RefereeOfDegree : public ::testing::TestWithParam<int> {};

TEST_P(RefereeOfDegree, agrees_with_dense_samples) {
  std::mt19937 engine(static_cast<unsigned>(GetParam()));
  int free = 0, colliding = 0;
  for (int k = 0; k < 40; ++k) {
    const RandomMotion motion(engine, GetParam());
    const ArmAndBall cell(engine, k % 2 == 0 ? 0 : 0.03);
    const MotionVerdict verdict = verdict_of(motion.path(cell.model), cell.bodies, cell.pairs);
    check_by_samples(verdict, motion, cell);
    if (HasFatalFailure()) FAIL() << k;
    free += verdict.status == MotionStatus::free ? 1 : 0;
    colliding += verdict.status == MotionStatus::collides ? 1 : 0;
  }
  // The motions are of both kinds, and none is left open.
  EXPECT_EQ(free + colliding, 40);
  EXPECT_GE(free, 8);
  EXPECT_GE(colliding, 8);
}
INSTANTIATE_TEST_SUITE_P(Motions, RefereeOfDegree, ::testing::Values(1, 3, 5));

TEST(Referee, each_step_has_its_own_least_clearance) {
  std::mt19937 engine(11);
  const RandomMotion motion(engine, 3);
  const ArmAndBall cell(engine);
  RefereeOptions options;
  options.every_step = true;
  const MotionVerdict verdict =
      verdict_of(motion.path(cell.model), cell.bodies, cell.pairs, options);
  ASSERT_EQ(verdict.steps.size(), 4u);
  for (std::size_t step = 0; step < 4; ++step) {
    Long least = 1e30L;
    for (int i = 0; i <= 2000; ++i) {
      const auto rods = motion.at(Long(step_length) * (step + i / 2000.0L));
      for (std::size_t pair = 0; pair < cell.pairs.size(); ++pair)
        least = std::min(least, cell.clearance(pair, rods));
    }
    if (verdict.steps[step].upper > 0) {
      EXPECT_LE(verdict.steps[step].lower, double(least) + 1e-9) << step;
      EXPECT_NEAR(verdict.steps[step].upper, double(least), 0.02 * std::abs(double(least)) + 1e-6);
    }
  }
}

TEST(Referee, answers_the_same_with_any_number_of_threads) {
  std::mt19937 engine(5);
  const RandomMotion motion(engine, 1);
  const ArmAndBall cell(engine);
  const JointPath path = motion.path(cell.model);
  MotionVerdict one, many;
  with_threads(1, [&] { one = verdict_of(path, cell.bodies, cell.pairs); });
  with_threads(4, [&] { many = verdict_of(path, cell.bodies, cell.pairs); });
  EXPECT_EQ(one.status, many.status);
  EXPECT_EQ(one.least.lower, many.least.lower);
  EXPECT_EQ(one.least.upper, many.least.upper);
  EXPECT_EQ(one.distances, many.distances);
}

/// A ball on a base that slides and turns in a plane, and one that floats; a post between them.
TEST(Referee, bases_move_in_planes_and_float) {
  const std::string text = R"(<robot name="r">
    <link name="world"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
    <link name="base"><collision><origin xyz="0.5 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
    <link name="bird"><collision><origin xyz="0 0.5 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
    <joint name="drive" type="planar"><parent link="world"/><child link="base"/><axis xyz="0 0 1"/></joint>
    <joint name="fly" type="floating"><parent link="world"/><child link="bird"/></joint></robot>)";
  const Model model = model_of(text, "r.urdf");
  // The base goes round half a turn while it slides; the bird turns about x by a quarter.
  const double half = std::sqrt(0.5);
  const std::vector<JointRow> rows = {
      {0, {{"drive", {-1, 0.3, 0}}, {"fly", {0, 0, 2, 1, 0, 0, 0}}}},
      {2, {{"drive", {1, 0.3, 3}}, {"fly", {0, 0.4, 0.5, half, half, 0, 0}}}}};
  const std::vector<ClearanceBody> bodies = bodies_of(model, GeometryChoice::collision);
  ASSERT_EQ(bodies.size(), 3u);
  for (const auto& pair : {RefereePair{0, 1, 0}, RefereePair{0, 2, 0}, RefereePair{1, 2, 0}}) {
    const auto gap = [&](Long s) {
      const Long angle = 3 * s, tilt = s * 3.14159265358979323846L / 2;
      const Vec3<Long> post(0, 0, 0),
          base(-1 + 2 * s + 0.5L * std::cos(angle), 0.3L + 0.5L * std::sin(angle), 0),
          bird(0, 0.4L * s + 0.5L * std::cos(tilt), 2 - 1.5L * s + 0.5L * std::sin(tilt));
      const std::array<Vec3<Long>, 3> at = {post, base, bird};
      return (at[pair.a] - at[pair.b]).norm() - 0.2L;
    };
    Long least = 1e30L;
    for (int i = 0; i <= 20000; ++i) least = std::min(least, gap(i / 20000.0L));
    RefereeOptions options;
    options.tolerance = 1e-4;
    const MotionVerdict verdict = verdict_of(JointPath(model, rows), bodies, {pair}, options);
    if (least < 0) {
      EXPECT_EQ(verdict.status, MotionStatus::collides) << pair.a << pair.b;
      continue;
    }
    EXPECT_EQ(verdict.status, MotionStatus::free) << pair.a << pair.b;
    EXPECT_LE(verdict.least.lower, double(least) + 1e-12);
    EXPECT_NEAR(verdict.least.lower, double(least), 1e-3 * double(least));
  }
}

TEST(Referee, what_a_budget_leaves_open_is_undecided) {
  // The hand grazes a wall: it touches it with the clearance of rounding.
  std::mt19937 engine(1);
  ArmAndBall cell(engine);
  Scene scene;
  scene.objects.resize(1);
  // The hand's ball is at 0.1 + 1 + 0.8 + 0.1 high, and slides along x with the shoulder still.
  scene.objects[0].half_space = HalfSpaceBody<double>{{0, 0, -1}, -2.07};
  cell.bodies.push_back(bodies_of(scene)[0]);
  const std::vector<JointRow> rows = {{0, {{"shoulder", {0}}, {"elbow", {0}}, {"wrist", {-0.1}}}},
                                      {1, {{"shoulder", {0}}, {"elbow", {0}}, {"wrist", {0}}}},
                                      {2, {{"shoulder", {0}}, {"elbow", {0}}, {"wrist", {-0.1}}}}};
  RefereeOptions options;
  options.budget = 200;
  const MotionVerdict verdict =
      verdict_of(JointPath(cell.model, rows), cell.bodies, {{3, 5, 0}}, options);
  EXPECT_EQ(verdict.status, MotionStatus::undecided);
  ASSERT_FALSE(verdict.stretches.empty());
  EXPECT_NEAR(verdict.stretches[0].begin, 1, 0.05);
}

TEST(JointPiece, bounds_hold_and_are_near) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> any(-2, 2);
  for (int k = 0; k < 2000; ++k) {
    JointEnds ends{
        any(engine), any(engine), {any(engine), any(engine)}, {any(engine), any(engine)}};
    const JointPiece piece = k % 2 == 0 ? JointPiece::cubic(ends) : JointPiece::quintic(ends);
    double largest = 0, fastest = 0, bent = 0;
    for (int i = 0; i <= 400; ++i) {
      const double s = i / 400.0, h = 1e-4;
      largest = std::max(largest, std::abs(piece.at(s).high));
      fastest = std::max(fastest, std::abs(piece.derivative_at(s)));
      bent = std::max(bent,
                      std::abs(piece.derivative_at(s + h) - piece.derivative_at(s - h)) / (2 * h));
    }
    ASSERT_GE(piece.largest(), largest);
    ASSERT_GE(piece.fastest(), fastest);
    // The quotient of differences looks a little beyond the ends.
    ASSERT_GE(piece.most_bent() * 1.01 + 1e-3, bent);
    // The coefficients of Chebyshev's polynomials of degree 2 and 4 are that much larger than they.
    ASSERT_LE(piece.fastest(), (k % 2 == 0 ? 3.0 : 35.0 / 3) * 1.01 * fastest);
    EXPECT_NEAR(piece.at(0).high, ends.first, 1e-15);
    EXPECT_NEAR(piece.at(1).high, ends.last, 1e-13);
    EXPECT_NEAR(piece.derivative_at(0), ends.rates[0], 1e-13);
    EXPECT_NEAR(piece.derivative_at(1), ends.rates[1], 1e-12);
  }
}

}  // namespace
}  // namespace minkray
