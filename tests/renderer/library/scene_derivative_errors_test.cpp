// SPDX-License-Identifier: MIT
// Bounds of the errors of derivatives of a scene's distances and of clearances, through the
// library, compared with closed forms.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace {

namespace mk = minkray;

double length(long double x, long double y, long double z) {
  return static_cast<double>(std::sqrt(x * x + y * y + z * z));
}
double difference(const mk::Vec3& v, double x, double y, double z) {
  return length(v.x - x, v.y - y, v.z - z);
}

TEST(SceneDerivativeErrors, of_two_balls) {
  mk::Scene scene;
  scene.add(mk::sphere(1));
  scene.add(mk::sphere(0.5), mk::translation({3, 4, 0}));
  scene.add(mk::box({1, 1, 1}), mk::translation({50, 0, 0}));
  scene.add(mk::box({1, 1, 1}), mk::translation({53, 0, 0}));
  scene.commit();
  mk::NearOptions options;
  options.within = 4;
  options.derivatives = options.derivative_errors = true;
  const mk::ScenePairs pairs = scene.distances(options);
  ASSERT_EQ(pairs.size(), 2u);
  ASSERT_EQ(pairs.errors().size(), 2u);
  const mk::PairDerivativeError& error = pairs.errors()[0];
  EXPECT_LE(difference(pairs[0].by_b.velocity, 0.6, 0.8, 0), error.b.velocity);
  EXPECT_LE(difference(pairs[0].by_a.velocity, -0.6, -0.8, 0), error.a.velocity);
  EXPECT_LE(difference(pairs[0].by_b.turn, 0, 0, 0), error.b.turn);
  EXPECT_LT(error.a.velocity + error.b.velocity + error.a.turn + error.b.turn, 1e-12);
  EXPECT_NE(pairs[1].is_ridge, 0);
  EXPECT_TRUE(std::isinf(pairs.errors()[1].a.turn));
  options.derivative_errors = false;
  EXPECT_EQ(scene.distances(options).errors().size(), 0u);
}

TEST(SceneDerivativeErrors, of_bodies_above_half_spaces) {
  mk::Scene scene;
  scene.add_half_space({0, 0, 1}, -2);
  // The lowest point of a leaning capsule: the lower end of its segment.
  const double s = std::sin(0.3), c = std::cos(0.3);
  mk::Pose lean = mk::translation({1, 2, 3});
  lean.rows[0][0] = lean.rows[2][2] = c;
  lean.rows[0][2] = s;
  lean.rows[2][0] = -s;
  scene.add(mk::capsule(0.25, 0.75), lean);
  scene.add(mk::cylinder(0.25, 0.75), mk::translation({9, 9, 0}));
  // A cube as a mesh on one of its faces, and leaning.
  std::vector<mk::Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  const std::vector<std::uint32_t> triangles = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6,
                                                0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7,
                                                0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  const mk::Shape cube = mk::mesh(corners, triangles);
  scene.add(cube, mk::translation({20, 0, 0}));
  mk::Pose corner_down = mk::pose({20, 20, 0}, {0.9, 0.3, 0.2, 0.25});
  scene.add(cube, corner_down);
  scene.commit();
  mk::NearOptions options;
  options.derivatives = options.derivative_errors = true;
  const std::vector<mk::ObjectPair> asked = {{0, 1}, {2, 0}, {0, 3}, {0, 4}};
  const mk::ScenePairs pairs = scene.distances(asked, options);
  ASSERT_EQ(pairs.size(), 4u);
  const mk::View<const mk::PairDerivativeError> errors = pairs.errors();
  EXPECT_LE(difference(pairs[0].by_b.velocity, 0, 0, 1), errors[0].b.velocity);
  EXPECT_LE(difference(pairs[0].by_b.turn, 0, 0.75 * s, 0), errors[0].b.turn);
  EXPECT_LT(errors[0].b.turn, 1e-12);
  // The half-space turns about its point nearest to the world's origin, or another: A's arm.
  EXPECT_LT(errors[0].a.turn, 1e-12);
  EXPECT_NE(pairs[1].is_ridge, 0);
  EXPECT_TRUE(std::isinf(errors[1].a.turn));
  EXPECT_NE(pairs[2].is_ridge, 0) << "four vertices are lowest";
  EXPECT_TRUE(std::isinf(errors[2].b.turn));
  EXPECT_EQ(pairs[3].is_ridge, 0);
  // The arm from the mesh's origin to its lowest vertex.
  double lowest = 9;
  mk::Vec3 arm{};
  for (const mk::Vec3& corner : corners) {
    const auto& r = corner_down.rows;
    const double z = r[2][0] * corner.x + r[2][1] * corner.y + r[2][2] * corner.z;
    if (z >= lowest) continue;
    lowest = z;
    arm = {r[0][0] * corner.x + r[0][1] * corner.y + r[0][2] * corner.z,
           r[1][0] * corner.x + r[1][1] * corner.y + r[1][2] * corner.z, z};
  }
  EXPECT_LE(difference(pairs[3].by_b.turn, arm.y, -arm.x, 0), errors[3].b.turn);
  EXPECT_LT(errors[3].b.turn, 1e-11);
}

TEST(SceneDerivativeErrors, of_ellipsoids_above_half_spaces) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  mk::Scene scene;
  scene.add_half_space({0, 0, 1}, 0);
  const double axes[] = {0.9, 0.5, 0.3};
  std::vector<mk::Pose> poses;
  for (int i = 0; i < 200; ++i) {
    double q[4], n = 0;
    for (double& x : q) {
      x = normal(random);
      n += x * x;
    }
    n = std::sqrt(n);
    poses.push_back(mk::pose({0.05 * i, 0, 2}, {q[0] / n, q[1] / n, q[2] / n, q[3] / n}));
    scene.add(mk::ellipsoid({axes[0], axes[1], axes[2]}), poses.back());
  }
  scene.commit();
  std::vector<mk::ObjectPair> asked;
  for (std::uint32_t i = 1; i <= poses.size(); ++i) asked.push_back({0, i});
  mk::NearOptions options;
  options.derivatives = options.derivative_errors = true;
  const mk::ScenePairs pairs = scene.distances(asked, options);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto& r = poses[i].rows;
    // Support of an ellipsoid along -z: -E^2 d / |E d| with d the third row of the rotation.
    long double scaled[3], square = 0;
    for (int k = 0; k < 3; ++k) {
      scaled[k] = static_cast<long double>(axes[k]) * r[2][k];
      square += scaled[k] * scaled[k];
    }
    long double arm[3] = {};
    for (int row = 0; row < 3; ++row)
      for (int k = 0; k < 3; ++k) arm[row] -= r[row][k] * axes[k] * scaled[k] / std::sqrt(square);
    const mk::Vec3& turn = pairs[i].by_b.turn;
    EXPECT_LE(length(turn.x - arm[1], turn.y + arm[0], turn.z), pairs.errors()[i].b.turn);
    EXPECT_LT(pairs.errors()[i].b.turn, 1e-12);
  }
}

TEST(SceneDerivativeErrors, of_nearest_objects) {
  mk::Scene scene;
  scene.add(mk::sphere(1));
  scene.commit();
  mk::NearOptions options;
  options.derivatives = options.derivative_errors = true;
  const std::vector<mk::Vec3> points = {{3, 4, 0}};
  const mk::ScenePairs two = scene.nearest(points, 2, options);
  EXPECT_LE(difference(two[0].by_a.velocity, 0.6, 0.8, 0), two.errors()[0].a.velocity);
  EXPECT_LT(two.errors()[0].a.velocity, 1e-13);
  EXPECT_TRUE(std::isnan(two.errors()[1].a.velocity)) << "there is no second object";
  const mk::Shape ball = mk::sphere(2);
  const mk::Pose pose = mk::translation({3, 4, 0});
  mk::ScenePair found;
  mk::PairDerivativeError error;
  options.pair_errors = {&error, 1};
  scene.distance_to({{&ball, 1}, {&pose, 1}, {}}, {&found, 1}, options);
  EXPECT_LE(difference(found.by_a.velocity, 0.6, 0.8, 0), error.a.velocity);
  EXPECT_LT(error.a.velocity, 1e-12);
  options.derivatives = false;
  error.a.velocity = 7;
  scene.distance_to({{&ball, 1}, {&pose, 1}, {}}, {&found, 1}, options);
  EXPECT_LT(error.a.velocity, 1e-12);
  EXPECT_EQ(found.by_a.velocity.x, 0);
}

TEST(SceneDerivativeErrors, are_not_written_for_older_programs) {
  mk::Scene scene;
  scene.add(mk::sphere(1));
  scene.commit();
  mk::NearOptions options;
  minkray_near_options old = mk::detail::plain(options);
  old.size = offsetof(minkray_near_options, jac_error);
  double untouched[4] = {7, 7, 7, 7};
  old.jac_error = untouched;
  const double point[1][3] = {{4, 0, 0}};
  minkray_scene_pair pair;
  EXPECT_EQ(minkray_scene_nearest(scene.handle(), point, 1, 1, &old, &pair, nullptr), MINKRAY_OK);
  EXPECT_EQ(untouched[0], 7);
  old.size = offsetof(minkray_near_options, jac_errors);
  EXPECT_EQ(minkray_scene_nearest(scene.handle(), point, 1, 1, &old, &pair, nullptr), MINKRAY_OK);
  EXPECT_LT(untouched[0], 1e-12);
}

/// An arm of two hinges and a slide, with a ball at its end.
class Arm : public testing::Test {
 protected:
  Arm() : robot_(scene_.add_file(folder_.write("arm.urdf", urdf()), options())) {
    scene_.add(mk::sphere(0.25), mk::translation({1.5, 1.0, 0.5}));
    scene_.commit();
  }
  static mk::FileOptions options() {
    mk::FileOptions options;
    options.geometry = "collision";
    return options;
  }
  static std::string urdf() {
    const std::string ball =
        "<collision><origin xyz='0 0.125 0'/><geometry><sphere radius='0.1'/></geometry>"
        "</collision>";
    const auto joint = [](const std::string& name, const std::string& type,
                          const std::string& parent, const std::string& axis,
                          const std::string& x) {
      return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
             "'/><child link='of_" + name + "'/><origin xyz='" + x + " 0 0'/><axis xyz='" + axis +
             "'/><limit lower='-9' upper='9' effort='1' velocity='1'/></joint>";
    };
    return "<robot name='arm'><link name='base'/><link name='of_first'/><link name='of_second'/>"
           "<link name='of_third'>" +
           ball + "</link>" + joint("first", "revolute", "base", "0 0 1", "0.5") +
           joint("second", "revolute", "of_first", "0 1 0", "0.75") +
           joint("third", "prismatic", "of_second", "1 0 0", "0.5") + "</robot>";
  }

  minkray::TemporaryFolder folder_;
  mk::Scene scene_;
  mk::Scene::Group robot_;
};

TEST_F(Arm, has_bounds_of_its_clearances_derivative) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> value(-1.4, 1.4);
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    const double q[3] = {value(random), value(random), value(random)};
    mk::Clearance step;
    double jac[3], error[3];
    std::uint8_t is_ridge = 0;
    scene_.clearance_derivatives(robot_, q, 1, {&step, 1}, jac, {&is_ridge, 1}, error);
    const long double s1 = std::sin(static_cast<long double>(q[0])),
                      c1 = std::cos(static_cast<long double>(q[0])),
                      s2 = std::sin(static_cast<long double>(q[1])),
                      c2 = std::cos(static_cast<long double>(q[1]));
    // In the plane of the first link: u along it; the ball is 0.125 off it.
    const long double reach = 0.5L + q[2], u = 0.75L + reach * c2, z = -reach * s2, v = 0.125L;
    const long double x = 0.5L + c1 * u - s1 * v, y = s1 * u + c1 * v;
    const long double to[3] = {x - 1.5L, y - 1.0L, z - 0.5L};
    const long double far = std::sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
    const long double by[3][3] = {{-s1 * u - c1 * v, c1 * u - s1 * v, 0},
                                  {-c1 * reach * s2, -s1 * reach * s2, -reach * c2},
                                  {c1 * c2, s1 * c2, -s2}};
    if (far < 0.5L) continue;  // their surfaces may touch
    EXPECT_EQ(is_ridge, 0);
    for (int k = 0; k < 3; ++k) {
      const long double truth = (by[k][0] * to[0] + by[k][1] * to[1] + by[k][2] * to[2]) / far;
      EXPECT_LE(std::abs(static_cast<double>(jac[k] - truth)), error[k]);
      worst = std::max(worst, error[k]);
    }
  }
  EXPECT_LT(worst, 1e-9);
  // Bounds alone are the same.
  const double at_rest[3] = {};
  double jac[3], error[3], alone[3] = {};
  scene_.clearance_derivatives(robot_, at_rest, 1, {}, jac, {}, error);
  minkray_clearance_options options = {};
  options.size = sizeof options;
  options.jac_error = alone;
  EXPECT_EQ(minkray_scene_clearance_derivatives(scene_.handle(), robot_.number(), at_rest, 1, 3,
                                                &options, nullptr, nullptr, nullptr),
            MINKRAY_OK);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(alone[k], error[k]);
  const double path[6] = {};
  EXPECT_THROW(scene_.clearance_derivatives(robot_, path, 2, {}, jac, {}, {error, 2}), mk::Error);
}

TEST_F(Arm, has_infinite_bounds_on_ridges) {
  scene_.add(mk::sphere(0.25), mk::translation({2.5, 0, 0.125}));
  scene_.add(mk::sphere(0.25), mk::translation({2.5, 0.25, 0.125}));
  scene_.commit();
  const double q[3] = {};
  double jac[3], error[3];
  std::uint8_t is_ridge = 0;
  scene_.clearance_derivatives(robot_, q, 1, {}, jac, {&is_ridge, 1}, error);
  EXPECT_EQ(is_ridge, 1);
  EXPECT_TRUE(std::isinf(error[0]));
}

}  // namespace
