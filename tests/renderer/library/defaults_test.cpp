// SPDX-License-Identifier: MIT
// Omitted values have the documented defaults, and values without a meaning are an error: a Pose
// was singular by default, a ray of zeros a miss, and a miss of moving shapes had a time.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/renderer/library/errors.h"

namespace {

namespace mk = minkray;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Work>
void expect_error(const std::string& text, Work&& work) {
  EXPECT_TRUE(has(minkray::message_of<mk::Error>(work), text));
}

TEST(Defaults, a_pose_is_the_identity) {
  const mk::Pose by_default{}, identity = mk::identity();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) {
      EXPECT_EQ(by_default.rows[i][j], i == j ? 1 : 0);
      EXPECT_EQ(identity.rows[i][j], i == j ? 1 : 0);
    }
  const mk::Pose given = {{{1, 0, 0, 5}, {0, 1, 0, 6}, {0, 0, 1, 7}}};  // Pose is an aggregate
  EXPECT_EQ(given.rows[2][3], 7);
  EXPECT_EQ(mk::signed_distance(mk::sphere(1), {}, mk::sphere(1), mk::translation({4, 0, 0})).value,
            2);
}

TEST(Defaults, a_limit_of_zero_in_a_struct_is_no_limit) {
  mk::Scene scene;
  const mk::Shape ball = mk::sphere(1);
  scene.add(ball);
  scene.commit();
  const minkray_ray c_ray = {{-5, 0, 0}, {1, 0, 0}, 0};
  minkray_hit c_hit;
  ASSERT_EQ(minkray_scene_cast(scene.handle(), &c_ray, 1, &c_hit, nullptr), MINKRAY_OK);
  EXPECT_EQ(c_hit.status, MINKRAY_HIT);
  EXPECT_EQ(c_hit.t, 4);
  const mk::Ray ray = {{-5, 0, 0}, {1, 0, 0}, 0};
  EXPECT_EQ(mk::cast(ball, ray).t, 4);
  EXPECT_EQ(scene.exit(0, ray).t, 6);
  EXPECT_EQ(scene.occluded(ray), mk::hit);
  // In any number, with others: as rays without an end.
  std::vector<mk::Ray> zero, endless;
  for (int i = 0; i < 5000; ++i) {
    const mk::Vec3 origin = {-5, i % 71 * 0.04 - 1.4, i / 71 * 0.04 - 1.4};
    zero.push_back({origin, {1, 0, 0}, i % 3 == 0 ? 4.2 : 0});
    endless.push_back({origin, {1, 0, 0}, i % 3 == 0 ? 4.2 : infinity});
  }
  std::vector<mk::Hit> of_zero(zero.size()), of_endless(zero.size());
  std::vector<std::uint8_t> blocked(zero.size());
  std::vector<mk::Proof> proofs(zero.size());
  scene.cast(zero, of_zero);
  scene.cast(endless, of_endless);
  scene.occluded(zero, blocked);
  scene.prove(zero, of_zero, proofs);
  std::size_t met = 0;
  for (std::size_t i = 0; i < zero.size(); ++i) {
    EXPECT_EQ(of_zero[i].t, of_endless[i].t);
    EXPECT_EQ(blocked[i] == mk::hit, of_zero[i].found());
    EXPECT_TRUE(proofs[i].holds) << proofs[i].complaint;
    met += of_zero[i].found();
  }
  EXPECT_GT(met, 1000u);
  EXPECT_LT(met, 4000u);
  // In an array it ends the ray.
  const double end = 0;
  double t = 0;
  minkray_ray_arrays arrays = {};
  arrays.size = sizeof arrays;
  arrays.origins = c_ray.origin;
  arrays.directions = c_ray.direction;
  arrays.t_max = &end;
  minkray_hit_arrays hits = {};
  hits.size = sizeof hits;
  hits.t = &t;
  ASSERT_EQ(minkray_scene_cast_arrays(scene.handle(), &arrays, 1, &hits, nullptr), MINKRAY_OK);
  EXPECT_EQ(t, infinity);
}

/// t of each ray, or the error.
std::vector<double> cast_arrays(const mk::Scene& scene, const minkray_ray_arrays& rays,
                                std::size_t count, int code = MINKRAY_OK) {
  std::vector<double> t(count);
  minkray_hit_arrays hits = {};
  hits.size = sizeof hits;
  hits.t = t.data();
  EXPECT_EQ(minkray_scene_cast_arrays(scene.handle(), &rays, count, &hits, nullptr), code);
  return t;
}

/// All rays were the first one.
TEST(Defaults, strides_of_zero_mean_that_rays_are_contiguous) {
  mk::Scene scene;
  scene.add(mk::sphere(1));
  scene.commit();
  const double origins[3][3] = {{-5, 0, 0}, {-6, 0, 0}, {-7, 0, 0}},
               directions[3][3] = {{1, 0, 0}, {2, 0, 0}, {1, 0, 0}}, ends[3] = {9, 9, 5};
  minkray_ray_arrays rays = {};
  rays.size = sizeof rays;
  rays.origins = origins[0];
  rays.directions = directions[0];
  rays.t_max = ends;
  EXPECT_EQ(cast_arrays(scene, rays, 3), (std::vector{4.0, 2.5, infinity}));
  std::uint8_t blocked[3];
  ASSERT_EQ(minkray_scene_occluded(scene.handle(), &rays, 3, blocked, nullptr), MINKRAY_OK);
  EXPECT_EQ(blocked[0], MINKRAY_HIT);
  EXPECT_EQ(blocked[2], MINKRAY_MISS);
  // Programs that were linked with an older library mean one row for all rays.
  rays.size = offsetof(minkray_ray_arrays, float_origins);
  EXPECT_EQ(cast_arrays(scene, rays, 3), (std::vector{4.0, 4.0, 4.0}));
}

TEST(Defaults, rays_of_floats_have_the_answers_of_the_same_numbers_in_double) {
  mk::Scene scene;
  scene.add(mk::rounded(mk::box({0.5, 0.4, 0.3}), 0.1));
  scene.add(mk::sphere(0.7), mk::translation({1, 1, 0}));
  scene.commit();
  struct Row {
    float origin[3], direction[3], t_max, unused;
  };
  std::vector<Row> floats;
  std::vector<mk::Ray> doubles;
  for (int i = 0; i < 5000; ++i) {
    const float y = static_cast<float>(i % 71) * 0.04f - 1.4f,
                z = static_cast<float>(i / 71) * 0.04f - 1.4f;
    floats.push_back({{-5, y, z}, {1, 0.1f, z / 9}, i % 3 == 0 ? 4.7f : 9.1f, 0});
    const Row& row = floats.back();
    doubles.push_back({{row.origin[0], row.origin[1], row.origin[2]},
                       {row.direction[0], row.direction[1], row.direction[2]},
                       row.t_max});
  }
  std::vector<mk::Hit> hits(doubles.size());
  scene.cast(doubles, hits);
  minkray_ray_arrays rays = {};
  rays.size = sizeof rays;
  rays.float_origins = floats[0].origin;
  rays.float_directions = floats[0].direction;
  rays.float_t_max = &floats[0].t_max;
  rays.origin_stride = rays.direction_stride = rays.t_max_stride = sizeof(Row);
  const std::vector<double> t = cast_arrays(scene, rays, floats.size());
  std::size_t met = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    EXPECT_EQ(t[i], hits[i].t);
    met += hits[i].found();
  }
  EXPECT_GT(met, 500u);
  EXPECT_LT(met, 4000u);
  // Each array is of one of the types; here a contiguous one of double ends the rays.
  const std::vector<double> ends(floats.size(), 4.5);
  rays.float_t_max = nullptr;
  rays.t_max = ends.data();
  rays.t_max_stride = 0;
  const std::vector<double> shorter = cast_arrays(scene, rays, floats.size());
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_EQ(shorter[i], t[i] <= 4.5 ? t[i] : infinity);
  rays.float_t_max = &floats[0].t_max;
  cast_arrays(scene, rays, 2, MINKRAY_WRONG_USE);
  EXPECT_TRUE(has(minkray_last_error(), "rays.t_max, rays.float_t_max: must not both be given"));
  rays.t_max = nullptr;
  floats[1].direction[2] = std::numeric_limits<float>::quiet_NaN();
  cast_arrays(scene, rays, 2, MINKRAY_WRONG_USE);
  EXPECT_TRUE(has(minkray_last_error(), "rays[1].direction[2]: must be a finite number (got nan)"));
}

/// Options of zeros left everything out that did not touch.
TEST(Defaults, a_distance_of_zero_in_options_of_near_pairs_is_the_default) {
  mk::Scene scene;
  const mk::Shape ball = mk::sphere(1);
  scene.add(ball);
  scene.add(ball, mk::translation({5, 0, 0}));
  scene.add(ball, mk::translation({5, 2, 0}));
  scene.commit();
  minkray_near_options options = {};
  options.size = sizeof options;
  const double point[1][3] = {{0, 0, 4}};
  minkray_scene_pair found = {};
  ASSERT_EQ(minkray_scene_nearest(scene.handle(), point, 1, 1, &options, &found, nullptr),
            MINKRAY_OK);
  EXPECT_EQ(found.object_b, 0u);
  EXPECT_EQ(found.distance.value, 3);
  const minkray_shape shape = ball.handle();
  const minkray_pose pose = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 4}}};
  minkray_bodies body = {};
  body.size = sizeof body;
  body.shapes = &shape;
  body.shape_count = 1;
  body.poses = &pose.rows[0][0];
  body.pose_count = 1;
  ASSERT_EQ(minkray_scene_distance_to(scene.handle(), &body, 1, &options, &found, nullptr),
            MINKRAY_OK);
  EXPECT_EQ(found.object_b, 0u);
  const auto count = [](void* user, const minkray_scene_pair*, size_t pairs) {
    *static_cast<size_t*>(user) = pairs;
    return 0;
  };
  size_t pairs = 7;
  ASSERT_EQ(minkray_scene_distances(scene.handle(), nullptr, 0, &options, count, &pairs, nullptr),
            MINKRAY_OK);
  EXPECT_EQ(pairs, 1u);  // that touch
  const std::uint32_t given[2] = {0, 1};
  ASSERT_EQ(minkray_scene_distances(scene.handle(), given, 1, &options, count, &pairs, nullptr),
            MINKRAY_OK);
  EXPECT_EQ(pairs, 1u);
  // In C++ the default is no zero, and a zero means pairs that touch.
  const mk::Vec3 above = {0, 0, 4};
  mk::NearOptions touching;
  EXPECT_EQ(scene.nearest({&above, 1}, 1, touching).front().object_b, 0u);
  touching.within = 0;
  EXPECT_EQ(scene.nearest({&above, 1}, 1, touching).front().object_b, mk::no_object);
  EXPECT_EQ(scene.distances(touching).size(), 1u);
}

TEST(Defaults, a_direction_of_zero_is_an_error_wherever_a_ray_is_given) {
  mk::Scene scene;
  const mk::Shape ball = mk::sphere(1);
  scene.add(ball);
  scene.commit();
  const std::string text = "rays[0].direction: must not be zero";
  expect_error(text, [&] { (void)scene.cast(mk::Ray{}); });
  expect_error(text, [&] { (void)scene.cast({{0, 0, 0}, {0, -0.0, 0}}); });
  expect_error(text, [&] { (void)scene.occluded(mk::Ray{}); });
  expect_error(text, [&] { (void)scene.exit(0, mk::Ray{}); });
  expect_error(text, [&] { (void)scene.prove(mk::Ray{}, mk::Hit{}); });
  expect_error(text, [&] { (void)mk::cast(ball, mk::Ray{}); });
  std::vector<mk::Ray> rays(3000, {{-5, 0, 0}, {1, 0, 0}});
  rays[2047].direction = {};
  std::vector<mk::Hit> hits(rays.size());
  expect_error("minkray_scene_cast: rays[2047].direction: must not be zero",
               [&] { scene.cast(rays, hits); });
  const double zeros[3] = {0, 0, 0};
  minkray_ray_arrays arrays = {};
  arrays.size = sizeof arrays;
  arrays.origins = arrays.directions = zeros;
  minkray_hit_arrays found = {};
  found.size = sizeof found;
  EXPECT_EQ(minkray_scene_cast_arrays(scene.handle(), &arrays, 1, &found, nullptr),
            MINKRAY_WRONG_USE);
  // The least number is a direction.
  EXPECT_NO_THROW((void)scene.cast({{0, 0, 0}, {0, 0, 5e-324}}));
}

TEST(Defaults, shapes_that_do_not_meet_have_no_time_of_impact) {
  const mk::Shape ball = mk::sphere(1);
  const auto impact = [&](const mk::Twist& of_a, const mk::Twist& of_b, double t_max) {
    return mk::time_of_impact(ball, {}, of_a, ball, mk::translation({4, 0, 0}), of_b, t_max);
  };
  for (const mk::Vec3& turn : {mk::Vec3{}, mk::Vec3{0, 0, 0.1}}) {
    const mk::Impact miss = impact({}, {{9, 0, 0}, turn}, 10);
    EXPECT_EQ(miss.status, mk::no_impact);
    EXPECT_EQ(miss.t_lo, 10);
    EXPECT_EQ(miss.t_hi, infinity);
    const mk::Impact hit = impact({}, {{-1, 0, 0}, turn}, 10);
    EXPECT_EQ(hit.status, mk::impact);
    EXPECT_NEAR(hit.t_lo, 2, 1e-8);
    EXPECT_GE(hit.t_hi, hit.t_lo);
    EXPECT_LT(hit.t_hi, 2.1);
    EXPECT_NEAR(hit.point_a.x, 1, 1e-6);
    EXPECT_NEAR(hit.point_a[0], 1, 1e-6);
  }
  const mk::Impact inside = mk::time_of_impact(ball, {}, {}, ball, {}, {}, 1);
  EXPECT_EQ(inside.status, mk::begins_inside);
  EXPECT_TRUE(std::isfinite(inside.t_hi));
}

/// A distance that is unknown was 0.
TEST(Defaults, distance_of_a_miss_is_infinite_if_it_is_unknown) {
  const std::vector<mk::Vec3> corners = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  const mk::Shape ball = mk::sphere(1), mesh = mk::mesh(corners, {0, 1, 2});
  const auto distance = [](const mk::Shape& a, const mk::Shape& b, const mk::Vec3& velocity) {
    const mk::Impact miss =
        mk::time_of_impact(a, {}, {}, b, mk::translation({0, 0, 4}), {velocity, {}}, 10);
    EXPECT_EQ(miss.status, mk::no_impact);
    EXPECT_EQ(miss.t_lo, 10);
    return miss.distance;
  };
  EXPECT_NEAR(distance(ball, ball, {0, 0, 1}), 12, 1e-9);
  EXPECT_EQ(distance(ball, ball, {0, 0, 1e160}), infinity);
  EXPECT_EQ(distance(mesh, ball, {0, 0, 1}), infinity);
  EXPECT_EQ(distance(mesh, mesh, {0, 0, 1}), infinity);
  mk::Scene scene;
  scene.add(ball, {}, "ball");
  scene.commit();
  const mk::SceneImpact passed =
      scene.time_of_impact(ball, mk::translation({0, 0, 4}), {{0, 0, 1}, {}}, 10);
  EXPECT_EQ(passed.impact.status, mk::no_impact);
  EXPECT_EQ(passed.impact.distance, infinity);
}

TEST(Defaults, statuses_of_pairs_have_names) {
  const mk::Shape ball = mk::sphere(1);
  const auto status = [&](double x) {
    return mk::signed_distance(ball, {}, ball, mk::translation({x, 0, 0})).status;
  };
  EXPECT_EQ(status(3), mk::separated);
  EXPECT_EQ(status(2), mk::touching);
  EXPECT_EQ(status(1), mk::overlapping);
  EXPECT_EQ(status(3), MINKRAY_SEPARATED);
}

TEST(Defaults, views_of_other_sizes_are_errors_that_say_both) {
  mk::Scene scene;
  scene.add(mk::sphere(1));
  scene.commit();
  const std::vector<mk::Ray> rays(3, {{-5, 0, 0}, {1, 0, 0}});
  std::vector<mk::Hit> hits(2);
  std::vector<std::uint8_t> blocked(4);
  std::vector<mk::Proof> proofs(3);
  EXPECT_TRUE(has(error_of([&] { scene.cast(rays, hits); }),
                  "minkray::Scene::cast: hits: must be as many as rays, 3 (got 2)"));
  expect_error("minkray::Scene::occluded: answers: must be as many as rays, 3 (got 4)",
               [&] { scene.occluded(rays, blocked); });
  expect_error("minkray::Scene::prove: hits: must be as many as rays, 3 (got 2)",
               [&] { scene.prove(rays, hits, proofs); });
}

TEST(Defaults, what_a_support_function_throws_is_told) {
  bool throws = true;
  const auto support = [&](const mk::Vec3& n) {
    if (throws) throw std::runtime_error("boom");
    return n;
  };
  expect_error("the support function failed: boom", [&] { (void)mk::custom(support); });
  const auto batched = [&](mk::View<const mk::Vec3> n, mk::View<mk::Vec3> p) {
    for (std::size_t i = 0; i < n.size(); ++i) p[i] = support(n[i]);
  };
  expect_error("failed: boom", [&] { (void)mk::custom_batched(batched, 64); });
  throws = false;
  const mk::Shape ball = mk::custom(support);
  throws = true;
  expect_error("minkray_shape_cast: the support function failed: boom", [&] {
    (void)mk::cast(ball, {{-5, 0.1, 0}, {1, 0, 0}});
  });
  // A function for C that throws is its caller's fault, too; and one that gives a reason for its
  // failure.
  minkray_support given = {};
  given.function = [](void*, size_t, const double(*)[3], double(*)[3]) -> int {
    throw std::runtime_error("thrown through C");
  };
  minkray_shape shape;
  EXPECT_EQ(minkray_shape_custom(&given, &shape), MINKRAY_BAD_SUPPORT);
  EXPECT_TRUE(has(minkray_last_error(), "failed: thrown through C"));
  given.function = [](void*, size_t, const double(*)[3], double(*)[3]) -> int {
    minkray_support_failed("no file");
    return 7;
  };
  EXPECT_EQ(minkray_shape_custom(&given, &shape), MINKRAY_BAD_SUPPORT);
  EXPECT_TRUE(has(minkray_last_error(), "failed: no file"));
}

TEST(Defaults, what_a_progress_callback_throws_is_its_own_fault) {
  mk::Scene scene;
  scene.add(mk::sphere(1));
  scene.commit();
  const std::vector<mk::Ray> rays(5000, {{-5, 0, 0}, {1, 0, 0}});
  std::vector<mk::Hit> hits(rays.size());
  mk::Options options;
  options.progress = [](void*, double) -> int { throw std::runtime_error("late"); };
  expect_error("options.progress: must not throw (got \"late\")",
               [&] { scene.cast(rays, hits, options); });
}

}  // namespace
