// SPDX-License-Identifier: MIT
// Wrong use of the C interface is an error that names the mistake, and its place; nothing crashes.
#include <gtest/gtest.h>
#include <minkray/minkray_c.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "tests/renderer/library/errors.h"
#include "tests/support/source_files.h"

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The call failed with that code and message.
void expect_error(int code, int expected, const std::string& text) {
  EXPECT_EQ(code, expected);
  EXPECT_TRUE(has(minkray_last_error(), text));
}

minkray_shape ball(double radius = 1) {
  const minkray_parameter parameter = {"radius", &radius, 1, nullptr, 0};
  minkray_shape shape = {0};
  EXPECT_EQ(minkray_shape_make("sphere", &parameter, 1, &shape), MINKRAY_OK);
  return shape;
}

minkray_scene scene_with_a_ball() {
  minkray_scene scene = {0};
  EXPECT_EQ(minkray_scene_make(&scene), MINKRAY_OK);
  const minkray_shape shape = ball();
  EXPECT_EQ(minkray_scene_add(scene, shape, nullptr, "ball", nullptr), MINKRAY_OK);
  EXPECT_EQ(minkray_shape_release(shape), MINKRAY_OK);
  return scene;
}

const minkray_ray along_x = {{-5, 0, 0}, {1, 0, 0}, std::numeric_limits<double>::infinity()};

TEST(WrongUse, of_null_names_the_argument) {
  minkray_shape shape;
  expect_error(minkray_shape_make(nullptr, nullptr, 0, &shape), MINKRAY_WRONG_USE,
               "minkray_shape_make: kind: must not be NULL");
  expect_error(minkray_shape_make("box", nullptr, 1, &shape), MINKRAY_WRONG_USE, "parameters");
  expect_error(minkray_shape_make("box", nullptr, 0, nullptr), MINKRAY_WRONG_USE, "shape");
  expect_error(minkray_shape_custom(nullptr, &shape), MINKRAY_WRONG_USE, "support");
  expect_error(minkray_scene_make(nullptr), MINKRAY_WRONG_USE, "scene: must not be NULL");
  const minkray_scene scene = scene_with_a_ball();
  ASSERT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
  minkray_hit hit;
  expect_error(minkray_scene_cast(scene, nullptr, 1, &hit, nullptr), MINKRAY_WRONG_USE, "rays");
  expect_error(minkray_scene_cast(scene, &along_x, 1, nullptr, nullptr), MINKRAY_WRONG_USE, "hits");
  EXPECT_EQ(minkray_scene_cast(scene, nullptr, 0, nullptr, nullptr), MINKRAY_OK);  // no rays
  minkray_scene_release(scene);
}

TEST(WrongUse, of_a_parameter_names_it_and_what_it_must_be) {
  const double radius = -1;
  const minkray_parameter negative = {"radius", &radius, 1, nullptr, 0};
  minkray_shape shape;
  expect_error(minkray_shape_make("sphere", &negative, 1, &shape), MINKRAY_WRONG_USE,
               "sphere: /radius: must be > 0 (got -1.0)");
  const minkray_parameter is_nan = {"radius", &nan, 1, nullptr, 0};
  expect_error(minkray_shape_make("sphere", &is_nan, 1, &shape), MINKRAY_WRONG_USE,
               "sphere: /radius: must be a finite number");
  expect_error(minkray_shape_make("sphere", nullptr, 0, &shape), MINKRAY_WRONG_USE,
               "sphere: /radius: missing");
  expect_error(minkray_shape_make("spere", nullptr, 0, &shape), MINKRAY_WRONG_USE,
               "did you mean \"sphere\"?");
  const minkray_parameter unknown = {"radus", &radius, 1, nullptr, 0};
  expect_error(minkray_shape_make("sphere", &unknown, 1, &shape), MINKRAY_WRONG_USE,
               "/radus: is not known (did you mean \"radius\"?)");
  const minkray_shape none = {0};
  const double grow = 0.1;
  const minkray_parameter of_none[] = {{"radius", &grow, 1, nullptr, 0},
                                       {"shape", nullptr, 0, &none, 1}};
  expect_error(minkray_shape_make("rounded", of_none, 2, &shape), MINKRAY_WRONG_USE,
               "shape: must be a shape (got none)");
  expect_error(minkray_shape_read("{\"type\": \"box\"}", nullptr, &shape), MINKRAY_BAD_INPUT,
               "/half_extents: missing");
  expect_error(minkray_shape_read("{\"type\": ", nullptr, &shape), MINKRAY_BAD_INPUT, "shape: ");
}

TEST(WrongUse, of_what_was_released_is_found_whatever_was_made_since) {
  const minkray_shape gone = ball();
  ASSERT_EQ(minkray_shape_release(gone), MINKRAY_OK);
  std::vector<minkray_shape> others;
  for (int i = 0; i < 1000; ++i) others.push_back(ball());
  double lower[3], upper[3];
  expect_error(minkray_shape_bounds(gone, lower, upper), MINKRAY_WRONG_USE,
               "shape: must be a shape (got a released one, or none)");
  expect_error(minkray_shape_release(gone), MINKRAY_WRONG_USE, "released");
  expect_error(minkray_shape_retain(gone), MINKRAY_WRONG_USE, "released");
  for (const minkray_shape shape : others) EXPECT_EQ(minkray_shape_release(shape), MINKRAY_OK);

  const minkray_scene scene = scene_with_a_ball();
  ASSERT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
  ASSERT_EQ(minkray_scene_release(scene), MINKRAY_OK);
  minkray_hit hit;
  expect_error(minkray_scene_cast(scene, &along_x, 1, &hit, nullptr), MINKRAY_WRONG_USE,
               "scene: must be a scene (got a released one, or none)");
  // A scene is no shape, whatever their numbers are.
  expect_error(minkray_shape_bounds({scene.id}, lower, upper), MINKRAY_WRONG_USE, "shape");
}

TEST(WrongUse, of_a_shape_with_two_owners_begins_after_the_second_release) {
  const minkray_shape shape = ball();
  ASSERT_EQ(minkray_shape_retain(shape), MINKRAY_OK);
  ASSERT_EQ(minkray_shape_release(shape), MINKRAY_OK);
  const char* kind = nullptr;
  EXPECT_EQ(minkray_shape_kind(shape, &kind), MINKRAY_OK);
  EXPECT_STREQ(kind, "sphere");
  ASSERT_EQ(minkray_shape_release(shape), MINKRAY_OK);
  EXPECT_EQ(minkray_shape_kind(shape, &kind), MINKRAY_WRONG_USE);
}

TEST(WrongUse, of_a_scene_before_it_is_committed) {
  const minkray_scene scene = scene_with_a_ball();
  minkray_hit hit;
  expect_error(minkray_scene_cast(scene, &along_x, 1, &hit, nullptr), MINKRAY_WRONG_USE,
               "must be committed");
  ASSERT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
  EXPECT_EQ(minkray_scene_cast(scene, &along_x, 1, &hit, nullptr), MINKRAY_OK);
  EXPECT_EQ(hit.status, MINKRAY_HIT);
  EXPECT_EQ(hit.t, 4);
  const minkray_pose moved = {{{1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  ASSERT_EQ(minkray_scene_set_pose(scene, 0, &moved), MINKRAY_OK);
  expect_error(minkray_scene_cast(scene, &along_x, 1, &hit, nullptr), MINKRAY_WRONG_USE,
               "must be committed");
  minkray_scene_release(scene);
}

TEST(WrongUse, of_poses_and_rays_names_the_number) {
  const minkray_scene scene = scene_with_a_ball();
  ASSERT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
  const minkray_pose with_nan = {{{1, 0, 0, 0}, {0, 1, nan, 0}, {0, 0, 1, 0}}};
  expect_error(minkray_scene_set_pose(scene, 0, &with_nan), MINKRAY_WRONG_USE, "pose.rows[1][2]");
  const minkray_pose flat = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}}};
  expect_error(minkray_scene_set_pose(scene, 0, &flat), MINKRAY_WRONG_USE, "must be invertible");
  expect_error(minkray_scene_set_pose(scene, 1, &flat), MINKRAY_WRONG_USE, "invertible");
  const minkray_pose fine = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  expect_error(minkray_scene_set_pose(scene, 1, &fine), MINKRAY_WRONG_USE,
               "object: must be less than 1 (got 1)");
  // None of them has changed the scene.
  std::vector<minkray_ray> rays(40, along_x);
  std::vector<minkray_hit> hits(rays.size());
  ASSERT_EQ(minkray_scene_cast(scene, rays.data(), rays.size(), hits.data(), nullptr), MINKRAY_OK);
  rays[37].direction[2] = nan;
  expect_error(minkray_scene_cast(scene, rays.data(), rays.size(), hits.data(), nullptr),
               MINKRAY_WRONG_USE, "rays[37].direction[2]: must be a finite number");
  rays[12].t_max = -1;
  expect_error(minkray_scene_cast(scene, rays.data(), rays.size(), hits.data(), nullptr),
               MINKRAY_WRONG_USE, "rays[12].t_max: must be >= 0");
  minkray_options options = {sizeof options, -1, 0, nullptr, nullptr};
  expect_error(minkray_scene_cast(scene, &along_x, 1, hits.data(), &options), MINKRAY_WRONG_USE,
               "options.threads");
  options.size = 4;
  expect_error(minkray_scene_cast(scene, &along_x, 1, hits.data(), &options), MINKRAY_WRONG_USE,
               "options.size");
  minkray_scene_release(scene);
}

TEST(WrongUse, of_files_says_which) {
  const minkray_scene scene = scene_with_a_ball();
  expect_error(minkray_scene_add_file(scene, "no-such-file.json", nullptr, nullptr),
               MINKRAY_BAD_INPUT, "no-such-file.json");
  minkray_file_options options = {};
  options.size = sizeof options;
  options.geometry = "visble";
  expect_error(minkray_scene_add_file(scene, "robot.urdf", &options, nullptr), MINKRAY_WRONG_USE,
               "options.geometry");
  const double one = 1;
  expect_error(minkray_scene_set_joint(scene, 0, "elbow", &one, 1), MINKRAY_WRONG_USE,
               "group: must be less than 0 (got 0)");
  minkray_scene_release(scene);
}

TEST(WrongUse, of_pictures_says_which_option_or_channel) {
  const minkray_scene scene = scene_with_a_ball();
  minkray_picture_options options = {};
  options.size = sizeof options;
  options.width = 4;
  options.height = 2;
  std::vector<double> light(24);
  minkray_channel channel = {"rgb", light.data(), light.size()};
  const auto render = [&] { return minkray_scene_render(scene, &options, &channel, 1, nullptr); };
  options.view = R"({"camera": {"position": [0, -4, 0], "look_at": [0, 0, 0]}})";
  expect_error(render(), MINKRAY_WRONG_USE, "must be committed");
  ASSERT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
  ASSERT_EQ(render(), MINKRAY_OK) << minkray_last_error();
  channel.count = 23;
  expect_error(render(), MINKRAY_WRONG_USE, "channels[0].count: must be 24");
  channel = {"rgb", nullptr, 24};
  expect_error(render(), MINKRAY_WRONG_USE, "channels[0].values: must not be NULL");
  channel = {nullptr, light.data(), 24};
  expect_error(render(), MINKRAY_WRONG_USE, "channels[0].name: must not be NULL");
  channel = {"cryptomatte", light.data(), 24};
  expect_error(render(), MINKRAY_WRONG_USE, "channels[0].name: must be one of rgb, Z");
  channel = {"rgb", light.data(), 24};
  options.integrator = "paths";
  expect_error(render(), MINKRAY_WRONG_USE, "options.integrator: must be one of auto, path");
  options.integrator = nullptr;
  options.samples = 1u << 30;
  expect_error(render(), MINKRAY_WRONG_USE, "options.samples: must be at most");
  options.samples = 1;
  options.denoise = 1;
  expect_error(render(), MINKRAY_WRONG_USE, "options.samples: must be at least 2");
  options.denoise = 0;
  for (
      const auto& [view, text] : std::initializer_list<std::pair<const char*, const char*>>{
          {"{", "options.view"},
          {"[]", "must be an object"},
          {R"({"camera": 1})", "/camera"},
          {R"({"camera": {"position": [0, -4, 0], "look_at": [0, 0, 0]}, "objects": [1]})",
           "/objects/0"},
          {R"({"camera": {"position": [0, -4, 0], "look_at": [0, 0, 0]}, "lights": [{"type": "moon"}]})",
           "/lights/0/type"}}) {
    options.view = view;
    expect_error(minkray_scene_picture_size(scene, &options, nullptr, nullptr), MINKRAY_BAD_INPUT,
                 text);
  }
  options.size = 8;
  expect_error(render(), MINKRAY_WRONG_USE, "options.size");
  expect_error(minkray_scene_render(scene, nullptr, nullptr, 1, nullptr), MINKRAY_WRONG_USE,
               "channels: must not be NULL");
  minkray_scene_release(scene);
}

TEST(WrongUse, of_paths_and_lidars_says_what) {
  const minkray_scene scene = scene_with_a_ball();
  ASSERT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
  const double path[2] = {0, nan};
  minkray_clearance least;
  expect_error(minkray_scene_clearance(scene, 0, path, 1, 2, nullptr, nullptr, &least),
               MINKRAY_WRONG_USE, "group: must be less than 0");
  size_t needed = 0;
  expect_error(minkray_lidar_rays(nullptr, nullptr, nullptr, 0, &needed), MINKRAY_WRONG_USE,
               "pattern: must not be NULL");
  expect_error(minkray_lidar_rays("spinning:4x8", nullptr, nullptr, 1, &needed), MINKRAY_WRONG_USE,
               "rays: must not be NULL");
  expect_error(minkray_lidar_rays("no-such.csv", nullptr, nullptr, 0, &needed), MINKRAY_BAD_INPUT,
               "no-such.csv");
  ASSERT_EQ(minkray_lidar_rays("spinning:4x8", nullptr, nullptr, 0, &needed), MINKRAY_OK);
  EXPECT_EQ(needed, 32u);
  std::vector<minkray_ray> rays(3, along_x);
  ASSERT_EQ(minkray_lidar_rays("spinning:4x8", nullptr, rays.data(), 2, nullptr), MINKRAY_OK);
  EXPECT_LT(rays[0].direction[0], 0);  // begins behind
  EXPECT_EQ(rays[2].direction[0], along_x.direction[0]);
  ASSERT_EQ(minkray_lidar_rays("vlp-16:10", nullptr, nullptr, 0, &needed), MINKRAY_OK);
  EXPECT_EQ(needed, 160u);
  const char* const lens =
      R"({"fx": 2, "fy": 2, "cx": 0, "cy": 0, "width": 3, "height": 1, "k1": -0.3})";
  ASSERT_EQ(minkray_camera_rays(lens, nullptr, rays.data(), 3, &needed), MINKRAY_OK);
  EXPECT_EQ(needed, 3u);
  const double x = rays[1].direction[0];
  EXPECT_NEAR(x * (1 - 0.3 * x * x), 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(rays[2].direction[0]));  // beyond the fold
  expect_error(minkray_camera_rays(nullptr, nullptr, nullptr, 0, &needed), MINKRAY_WRONG_USE,
               "camera: must not be NULL");
  expect_error(minkray_camera_rays("{}", nullptr, nullptr, 0, &needed), MINKRAY_BAD_INPUT,
               "camera: /fx: missing");
  minkray_scene_release(scene);
}

/// Counts that went below zero; times the numbers of a row the first was less than one again, and
/// rows were read from where there is nothing.
TEST(WrongUse, of_counts_that_no_memory_holds_is_told) {
  constexpr std::size_t minus_one = std::numeric_limits<std::size_t>::max();
  minkray_scene scene;
  ASSERT_EQ(minkray_scene_make(&scene), MINKRAY_OK);
  uint32_t arm;
  ASSERT_EQ(minkray_scene_add_file(scene, (minkray::source_folder() / "examples/arm.urdf").c_str(),
                                   nullptr, &arm),
            MINKRAY_OK)
      << minkray_last_error();
  ASSERT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
  uint32_t joints;
  ASSERT_EQ(minkray_scene_group(scene, arm, nullptr, nullptr, &joints), MINKRAY_OK);
  const std::vector<double> path(joints);
  minkray_clearance least;
  for (const std::size_t rows : {minus_one, std::size_t{1} << 63, std::size_t{1} << 61})
    expect_error(
        minkray_scene_clearance(scene, arm, path.data(), rows, joints, nullptr, nullptr, &least),
        MINKRAY_WRONG_USE, "rows: must fit into memory");
  std::vector<double> far(2 * joints, -1e308);
  far.back() = 1e308;
  expect_error(minkray_scene_clearance(scene, arm, far.data(), 2, joints, nullptr, nullptr, &least),
               MINKRAY_WRONG_USE, "path: row 2 of 2: the joint");
  minkray_hit hit;
  expect_error(minkray_scene_cast(scene, &along_x, minus_one, &hit, nullptr), MINKRAY_WRONG_USE,
               "count: must fit into memory");
  minkray_scene_release(scene);
  const minkray_shape shape = ball();
  const double direction[1][3] = {{1, 0, 0}};
  double point[1][3];
  expect_error(minkray_shape_support(shape, minus_one, direction, point), MINKRAY_WRONG_USE,
               "count: must fit into memory");
  minkray_shape_release(shape);
}

/// A support function that waits, so that adding it takes as long as the test wants.
struct Gate {
  std::atomic<bool> closed = false, waiting = false;
  static int support(void* user, size_t count, const double (*n)[3], double (*p)[3]) {
    auto& gate = *static_cast<Gate*>(user);
    while (gate.closed) gate.waiting = true;
    for (size_t i = 0; i < count; ++i)
      for (int k = 0; k < 3; ++k) p[i][k] = std::copysign(1.0, n[i][k]);
    return 0;
  }
};

TEST(WrongUse, of_a_scene_by_two_threads_that_change_it) {
  Gate gate;
  const minkray_support support = {Gate::support, &gate, nullptr, nullptr, nullptr};
  minkray_shape shape;
  ASSERT_EQ(minkray_shape_custom(&support, &shape), MINKRAY_OK) << minkray_last_error();
  minkray_scene scene;
  ASSERT_EQ(minkray_scene_make(&scene), MINKRAY_OK);
  ASSERT_EQ(minkray_scene_add(scene, shape, nullptr, nullptr, nullptr), MINKRAY_OK);
  ASSERT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
  gate.closed = true;
  std::thread other([&] {
    EXPECT_EQ(minkray_scene_add(scene, shape, nullptr, nullptr, nullptr), MINKRAY_OK);
    EXPECT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
  });
  while (!gate.waiting) std::this_thread::yield();
  expect_error(minkray_scene_commit(scene), MINKRAY_WRONG_USE, "while another call is changing it");
  expect_error(minkray_scene_add(scene, shape, nullptr, nullptr, nullptr), MINKRAY_WRONG_USE,
               "while another call is changing it");
  minkray_hit hit;
  expect_error(minkray_scene_cast(scene, &along_x, 1, &hit, nullptr), MINKRAY_WRONG_USE,
               "while another call is changing it");
  gate.closed = false;
  other.join();
  EXPECT_EQ(minkray_scene_cast(scene, &along_x, 1, &hit, nullptr), MINKRAY_OK);
  minkray_scene_release(scene);
  minkray_shape_release(shape);
}

}  // namespace
