// SPDX-License-Identifier: MIT
// Many pairs and the pairs of a scene, by the C++ header and in C: the bits of each by itself,
// closed forms in long double, and what is refused.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/renderer/library/errors.h"
#include "tests/renderer/library/shapes.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace mk = minkray;

std::vector<mk::Pose> poses_of_pairs(std::size_t count, double reach, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-reach, reach);
  std::normal_distribution<double> turn;
  std::vector<mk::Pose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const mk::Vec3 at{place(random), place(random), place(random)};
    poses.push_back(mk::pose(at, {turn(random), turn(random), turn(random), turn(random)}));
  }
  return poses;
}

template <class Thing>
bool are_same_bits(const std::vector<Thing>& a, const std::vector<Thing>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

/// Two capsules: the distance of their axes less their radii, in long double.
long double distance_of_capsules(const mk::Pose& a, const mk::Pose& b, long double half,
                                 long double radii) {
  using Long = long double;
  const auto end = [half](const mk::Pose& pose, Long side, Long(&to)[3]) {
    for (int i = 0; i < 3; ++i) to[i] = Long(pose.rows[i][3]) + side * half * Long(pose.rows[i][2]);
  };
  Long p0[3], p1[3], q0[3], q1[3], d1[3], d2[3], r[3];
  end(a, -1, p0), end(a, 1, p1), end(b, -1, q0), end(b, 1, q1);
  Long aa = 0, ee = 0, ff = 0, cc = 0, bb = 0;
  for (int i = 0; i < 3; ++i) {
    d1[i] = p1[i] - p0[i], d2[i] = q1[i] - q0[i], r[i] = p0[i] - q0[i];
    aa += d1[i] * d1[i], ee += d2[i] * d2[i], ff += d2[i] * r[i], cc += d1[i] * r[i];
    bb += d1[i] * d2[i];
  }
  const auto within = [](Long x) { return std::min(std::max(x, Long(0)), Long(1)); };
  // C. Ericson, "Real-Time Collision Detection", 5.1.9.
  Long s = within((bb * ff - cc * ee) / (aa * ee - bb * bb)), t = (bb * s + ff) / ee;
  if (t < 0 || t > 1) {
    t = within(t);
    s = within((bb * t - cc) / aa);
  }
  Long squared = 0;
  for (int i = 0; i < 3; ++i) {
    const Long off = r[i] + s * d1[i] - t * d2[i];
    squared += off * off;
  }
  return std::sqrt(squared) - radii;
}

/// The pose, moved by a small twist along one of its axes.
mk::Pose twisted(const mk::Pose& pose, int axis, double by) {
  if (axis < 3) {
    mk::Pose moved = pose;
    moved.rows[axis][3] += by;
    return moved;
  }
  const double half = std::sin(by / 2);
  const mk::Quaternion q{axis == 3 ? half : 0, axis == 4 ? half : 0, axis == 5 ? half : 0,
                         std::cos(by / 2)};
  mk::Pose moved = mk::pose({0, 0, 0}, q) * pose;
  for (int i = 0; i < 3; ++i) moved.rows[i][3] = pose.rows[i][3];
  return moved;
}

TEST(LibraryPairs, are_the_bits_of_each_for_any_number_of_threads) {
  const std::vector<mk::Shape> kinds = some_shapes();
  constexpr std::size_t count = 400;
  std::vector<mk::Shape> a, b;
  for (std::size_t i = 0; i < count; ++i) {
    a.push_back(kinds[i % kinds.size()]);
    b.push_back(kinds[(i / kinds.size()) % kinds.size()]);
  }
  const std::vector<mk::Pose> at_a = poses_of_pairs(count, 1, 1),
                              at_b = poses_of_pairs(count, 1, 2);
  std::vector<mk::Distance> alone(count);
  for (std::size_t i = 0; i < count; ++i)
    alone[i] = mk::signed_distance(a[i], at_a[i], b[i], at_b[i]);
  for (const int threads : {0, 1, 3}) {
    std::vector<mk::Distance> found(count);
    mk::PairOptions options;
    options.how.threads = threads;
    mk::signed_distances({a, at_a, {}}, {b, at_b, {}}, found, options);
    EXPECT_TRUE(are_same_bits(found, alone)) << threads;
  }
  std::vector<mk::Distance> of_one(count);
  mk::signed_distances({{&a[0], 1}, {}, {}}, {b, at_b, {}}, of_one);
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_EQ(of_one[i].value, mk::signed_distance(a[0], {}, b[i], at_b[i]).value) << i;
}

TEST(LibraryPairs, errors_of_derivatives_have_bounds) {
  const mk::Shape ellipsoid = mk::ellipsoid({1, 2, 3}), box = mk::box({1, 1, 1});
  const mk::Pose above = mk::translation({0.3, 0.2, 5});
  std::vector<mk::Distance> found(1);
  std::vector<mk::Twist> by_b(1);
  std::vector<mk::DerivativeError> error_b(1);
  mk::PairOptions options;
  options.derivatives.by_b = by_b;
  options.derivatives.error_b = error_b;
  // On top of the face; about an axis across it the box is carried by its arm.
  mk::signed_distances({{&ellipsoid, 1}, {}, {}}, {{&box, 1}, {&above, 1}, {}}, found, options);
  EXPECT_NEAR(by_b[0].velocity.z, 1, error_b[0].velocity);
  EXPECT_NEAR(by_b[0].turn.x, -0.2, error_b[0].turn);
  EXPECT_NEAR(by_b[0].turn.y, 0.3, error_b[0].turn);
  EXPECT_LT(error_b[0].velocity, 1e-6);
  EXPECT_LT(error_b[0].turn, 1e-5);
  // Parallel faces have many derivatives.
  mk::signed_distances({{&box, 1}, {}, {}}, {{&box, 1}, {&above, 1}, {}}, found, options);
  EXPECT_TRUE(std::isinf(error_b[0].turn));
}

TEST(LibraryPairs, take_arrays_of_older_programs) {
  const mk::Shape ball = mk::sphere(1);
  const mk::Pose aside = mk::translation({3, 0, 0});
  minkray_bodies a = {}, b = {};
  a.size = b.size = sizeof a;
  a.shapes = b.shapes = reinterpret_cast<const minkray_shape*>(&ball);
  a.shape_count = b.shape_count = 1;
  b.poses = &aside.rows[0][0];
  b.pose_count = 1;
  double value = 0, untouched = 7;
  minkray_distance_arrays arrays = {};
  arrays.size = offsetof(minkray_distance_arrays, jac_error_a);
  arrays.value = &value;
  arrays.jac_error_a = &untouched;
  EXPECT_EQ(minkray_signed_distances(&a, &b, 1, nullptr, nullptr, &arrays, nullptr), MINKRAY_OK);
  EXPECT_EQ(value, 1);
  EXPECT_EQ(untouched, 7);
  --arrays.size;
  EXPECT_EQ(minkray_signed_distances(&a, &b, 1, nullptr, nullptr, &arrays, nullptr),
            MINKRAY_WRONG_USE);
}

TEST(LibraryPairs, derivatives_are_slopes_in_long_double) {
  constexpr std::size_t count = 300;
  constexpr double half = 0.5, radius = 0.2;
  const mk::Shape capsule = mk::capsule(radius, half);
  const std::vector<mk::Pose> at_a = poses_of_pairs(count, 2, 3),
                              at_b = poses_of_pairs(count, 2, 4);
  std::vector<mk::Distance> found(count);
  std::vector<mk::Twist> by_a(count), by_b(count);
  std::vector<std::uint8_t> is_ridge(count);
  mk::PairOptions options;
  options.derivatives = {by_a, by_b, is_ridge};
  mk::signed_distances({{&capsule, 1}, at_a, {}}, {{&capsule, 1}, at_b, {}}, found, options);
  const long double radii = 2 * static_cast<long double>(radius);
  std::size_t checked = 0;
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_NEAR(found[i].value,
                static_cast<double>(distance_of_capsules(at_a[i], at_b[i], half, radii)), 1e-13);
    if (is_ridge[i] != 0) continue;
    ++checked;
    for (int axis = 0; axis < 6; ++axis) {
      const double message = axis < 3 ? by_b[i].velocity[static_cast<std::size_t>(axis)]
                                      : by_b[i].turn[static_cast<std::size_t>(axis - 3)];
      double least = 1;
      for (const double step : {1e-4, 1e-6}) {
        const auto at = [&](double by) {
          return distance_of_capsules(at_a[i], twisted(at_b[i], axis, by), half, radii);
        };
        const long double slope = (at(step) - at(-step)) / (2 * static_cast<long double>(step));
        least = std::min(least, static_cast<double>(std::abs(slope - message)));
      }
      EXPECT_LT(least, 1e-6) << i << " " << axis;
    }
  }
  EXPECT_GT(checked, count - 3);
}

TEST(LibraryPairs, memories_are_values_that_make_it_faster) {
  std::vector<mk::Vec3> points;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 64; ++i) points.push_back({normal(random), normal(random), normal(random)});
  const mk::Shape hull = mk::hull(points);
  mk::PairMemory memory;
  int warm = 0, cold = 0;
  for (int frame = 0; frame < 50; ++frame) {
    const mk::Pose pose = mk::pose({6, 0.01 * frame, 0}, {0, 0, 0.01 * frame, 1});
    const mk::Distance kept = mk::signed_distance(hull, {}, hull, pose, memory);
    const mk::Distance anew = mk::signed_distance(hull, {}, hull, pose);
    EXPECT_NEAR(kept.value, anew.value, 1e-9);
    warm += kept.supports;
    cold += anew.supports;
  }
  EXPECT_LT(warm, cold * 3 / 4);
}

TEST(LibraryPairs, impacts_and_manifolds_are_those_of_each) {
  const mk::Shape box = mk::box({0.5, 0.4, 0.3}), plate = mk::box({5, 5, 1});
  const std::vector<mk::Pose> above = {mk::translation({0, 0, 3}), mk::translation({1, 0, 4})};
  const mk::Twist down{{0, 0, -1}, {0, 0, 0.3}};
  std::vector<mk::Impact> impacts(2);
  const double t_max = 9;
  mk::times_of_impact({{&box, 1}, above, {&down, 1}}, {{&plate, 1}, {}, {}}, {&t_max, 1}, impacts);
  EXPECT_NEAR(impacts[0].t_hi, 1.7, 1e-9);
  EXPECT_NEAR(impacts[1].t_hi, 2.7, 1e-9);
  std::vector<mk::Manifold> found(1);
  const mk::Pose resting = mk::translation({0, 0, 1.3});
  mk::manifolds({{&plate, 1}, {}, {}}, {{&box, 1}, {&resting, 1}, {}}, found);
  EXPECT_EQ(found[0].count, 4);
  for (const double gap : found[0].gaps) EXPECT_NEAR(gap, 0, 1e-12);
}

TEST(LibraryPairs, of_a_scene_in_c) {
  mk::Scene scene;
  const std::uint32_t ball = scene.add(mk::sphere(1), mk::translation({0, 0, 1.5}));
  const std::uint32_t ground = scene.add_half_space({0, 0, 1}, 0);
  const std::uint32_t other = scene.add(mk::sphere(1), mk::translation({2.25, 0, 5}));
  scene.commit();
  const minkray_near_options options = {sizeof options, 1, 0, 1, 0, nullptr, nullptr};
  std::vector<minkray_scene_pair> pairs;
  const auto take = [](void* user, const minkray_scene_pair* all, std::size_t count) {
    static_cast<std::vector<minkray_scene_pair>*>(user)->assign(all, all + count);
    return 0;
  };
  const auto ask = [&] {
    ASSERT_EQ(minkray_scene_distances(scene.handle(), nullptr, 0, &options, take, &pairs, nullptr),
              MINKRAY_OK)
        << minkray_last_error();
  };
  ask();
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].object_a, ball);
  EXPECT_EQ(pairs[0].object_b, ground);
  EXPECT_NEAR(pairs[0].distance.value, 0.5, 1e-14);
  EXPECT_NEAR(pairs[0].distance.normal[2], -1, 1e-14);
  EXPECT_NEAR(pairs[0].jac_a[2], 1, 1e-14);
  scene.set_pose(other, mk::translation({2.25, 0, 1.5}));
  scene.commit();
  ask();
  EXPECT_EQ(pairs.size(), 3u);
  EXPECT_EQ(minkray_scene_allow(scene.handle(), ball, other, 1), MINKRAY_OK);
  ask();
  EXPECT_EQ(pairs.size(), 2u);
  scene.remove(other);
  scene.commit();
  ask();
  EXPECT_EQ(pairs.size(), 1u);
}

TEST(LibraryPairs, what_is_wrong_is_told) {
  const mk::Shape ball = mk::sphere(1);
  std::vector<mk::Distance> found(3);
  std::vector<mk::Pose> poses(3);
  const auto text_of = [&](const mk::Bodies& a, const mk::PairOptions& options = {}) {
    return error_of([&] { mk::signed_distances(a, {{&ball, 1}, {}, {}}, found, options); });
  };
  EXPECT_EQ(text_of({{&ball, 1}, poses, {}}), "");
  EXPECT_TRUE(
      has(text_of({{&ball, 1}, {poses.data(), 2}, {}}), "a.poses: must be one, or as many"));
  EXPECT_TRUE(has(text_of({{}, poses, {}}), "a.shapes: must be one"));
  poses[1].rows[0][0] = 1.1;
  EXPECT_TRUE(has(text_of({{&ball, 1}, poses, {}}), "a.poses[1]: must be rigid"));
  poses[1].rows[0][0] = std::nan("");
  EXPECT_TRUE(has(text_of({{&ball, 1}, poses, {}}), "a.poses[1].rows[0][0]"));
  std::vector<mk::PairMemory> memories(2);
  mk::PairOptions options;
  options.memories = memories;
  EXPECT_TRUE(has(text_of({{&ball, 1}, {}, {}}, options), "memories: must be as many"));
}

/// Balls of radius 0.5 at x = 0, 1.2, 2.4.
mk::Scene row_of_balls() {
  mk::Scene scene;
  for (int i = 0; i < 3; ++i) scene.add(mk::sphere(0.5), mk::translation({1.2 * i, 0, 0}));
  scene.commit();
  return scene;
}

TEST(LibraryPairs, objects_of_a_scene_that_are_near_each_other) {
  mk::Scene scene = row_of_balls();
  const auto near = scene.distances(0.3);
  ASSERT_EQ(near.size(), 2u);
  for (std::uint32_t i = 0; i < 2; ++i) {
    EXPECT_EQ(near[i].object_a, i);
    EXPECT_EQ(near[i].object_b, i + 1);
    EXPECT_NEAR(near[i].distance.value, 0.2, 1e-15);
  }
  EXPECT_TRUE(scene.distances().empty());
  mk::NearOptions options;
  options.derivatives = true;
  const mk::ObjectPair ends[] = {{0, 2}};
  const auto asked = scene.distances(ends, options);
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_NEAR(asked[0].distance.value, 1.4, 1e-15);
  EXPECT_NEAR(asked[0].by_a.velocity.x, -1, 1e-12);
  EXPECT_NEAR(asked[0].by_b.velocity.x, 1, 1e-12);
  scene.allow(0, 1);
  EXPECT_EQ(scene.distances(0.3).size(), 1u);
  scene.set_masks(2, 2, 2);
  EXPECT_TRUE(scene.distances(0.3).empty());
  EXPECT_THROW(scene.distances(-1.0), mk::Error);
}

TEST(LibraryPairs, objects_of_a_scene_that_are_near_points_and_shapes) {
  const mk::Scene scene = row_of_balls();
  const mk::Vec3 points[] = {{0, 0, 1}, {2.3, 0, 2}};
  const auto nearest = scene.nearest(points, 2);
  ASSERT_EQ(nearest.size(), 4u);
  EXPECT_EQ(nearest[0].object_b, 0u);
  EXPECT_EQ(nearest[1].object_b, 1u);
  EXPECT_EQ(nearest[2].object_b, 2u);
  EXPECT_NEAR(nearest[2].distance.value, std::hypot(0.1, 2) - 0.5, 1e-14);

  const mk::ScenePair one = scene.distance_to(mk::sphere(0.1), mk::translation({2.4, 3, 0}));
  EXPECT_EQ(one.object_b, 2u);
  EXPECT_NEAR(one.distance.value, 2.4, 1e-14);

  const mk::SceneImpact met =
      scene.time_of_impact(mk::sphere(0.1), mk::translation({1.2, 3, 0}), {{0, -2, 0}, {}}, 9);
  EXPECT_EQ(met.object, 1u);
  EXPECT_LE(met.impact.t_lo, 1.2 + 1e-12);
  EXPECT_GE(met.impact.t_hi, 1.2 - 1e-12);
  EXPECT_NEAR(met.impact.t_hi, 1.2, 1e-9);

  const mk::Manifold between = scene.manifold(0, 1);
  EXPECT_EQ(between.count, 1);
  EXPECT_NEAR(between.gaps[0], 0.2, 1e-15);
}

/// Two balls of radius 0.5 that slide on an arm: at x = 0, 2 + slide_a and 4 + slide_b.
class SlidingBalls : public ::testing::Test {
 protected:
  SlidingBalls() : robot_(scene_.add_file(folder_.write("balls.urdf", urdf()), options())) {
    scene_.commit();
  }

  static mk::FileOptions options() {
    mk::FileOptions options;
    options.geometry = "collision";
    return options;
  }
  static std::string urdf() {
    std::string text = "<robot name='balls'>";
    for (const char* name : {"base", "a", "b"})
      text += "<link name='" + std::string(name) +
              "'><collision><geometry><sphere radius='0.5'/></geometry></collision></link>";
    for (const auto& [name, x] : {std::pair("a", "2"), std::pair("b", "4")})
      text += "<joint name='slide_" + std::string(name) +
              "' type='prismatic'><parent link='base'/><child link='" + name + "'/><origin xyz='" +
              x + " 0 0'/><limit lower='-9' upper='9' effort='1' velocity='1'/></joint>";
    return text + "</robot>";
  }

  minkray::TemporaryFolder folder_;
  mk::Scene scene_;
  mk::Scene::Group robot_;
};

TEST_F(SlidingBalls, have_derivatives_of_their_clearance) {
  // The two pass from 0.6 apart to 0.2 apart, and then apart again.
  const double path[] = {0, -0.4, 0.3, -0.5, 0, 0};
  mk::Clearance steps[2];
  double jac[4] = {};
  std::uint8_t is_ridge[2] = {7, 7};
  scene_.clearance_derivatives(robot_, path, 3, steps, jac, is_ridge);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(steps[i].upper, 0.2, 1e-9);
    EXPECT_EQ(steps[i].row, 1);
    EXPECT_NEAR(jac[2 * i], -1, 1e-12);
    EXPECT_NEAR(jac[2 * i + 1], 1, 1e-12);
    EXPECT_EQ(is_ridge[i], 0);
  }
  mk::Clearance same[2];
  scene_.clearance(robot_, path, 3, same);
  EXPECT_EQ(std::memcmp(same, steps, sizeof same), 0);
  EXPECT_EQ(minkray_scene_clearance_derivatives(scene_.handle(), robot_.number(), path, 3, 2,
                                                nullptr, nullptr, nullptr, nullptr),
            MINKRAY_OK);
  EXPECT_EQ(minkray_scene_clearance_derivatives(scene_.handle(), 9, path, 3, 2, nullptr, nullptr,
                                                jac, nullptr),
            MINKRAY_WRONG_USE);
  EXPECT_THROW(scene_.clearance_derivatives(robot_, path, 3, {}, {jac, 3}), mk::Error);
}

TEST_F(SlidingBalls, may_touch_as_a_file_says) {
  const double apart[] = {0, -1.2};
  EXPECT_NEAR(scene_.clearance(robot_, apart, 1).upper, -0.2, 1e-9);
  robot_.set("slide_b", -1.2);
  scene_.commit();
  EXPECT_EQ(scene_.distances().size(), 1u);
  scene_.allow_from_srdf(
      robot_,
      folder_.write("balls.srdf", "<robot><disable_collisions link1='b' link2='a'/></robot>"));
  EXPECT_TRUE(scene_.distances().empty());
  EXPECT_EQ(scene_.clearance(robot_, apart, 1).upper, std::numeric_limits<double>::infinity());
  const std::string wrong =
      folder_.write("wrong.srdf", "<robot><disable_collisions link1='b' link2='c'/></robot>");
  const minkray_scene scene = scene_.handle();
  EXPECT_EQ(minkray_scene_allow_from_srdf(scene, 0, wrong.c_str()), MINKRAY_BAD_INPUT);
  EXPECT_TRUE(has(minkray_last_error(), "there is no link \"c\""));
  EXPECT_EQ(minkray_scene_allow_from_srdf(scene, 0, nullptr), MINKRAY_WRONG_USE);
  EXPECT_EQ(minkray_scene_allow_from_srdf(scene, 5, wrong.c_str()), MINKRAY_WRONG_USE);
}

}  // namespace
