// SPDX-License-Identifier: MIT
#include "renderer/sensor/scan.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "core/parallel/parallel.h"
#include "renderer/film/render.h"
#include "renderer/sensor/npy.h"
#include "renderer/sensor/scan_files.h"
#include "renderer/sensor/sensor_path.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

/// Balls over a plane.
Scene balls() {
  Scene scene;
  scene.materials.push_back({"matt", LambertMaterial{}});
  testing::Random random(6);
  for (int i = 0; i < 60; ++i) {
    Object& object = scene.objects.emplace_back();
    object.name = "ball " + std::to_string(i);
    Sphere ball;
    ball.radius = 0.5;
    object.shape = ball;
    object.pose.translation = 4 * random.in_cube();
  }
  Object& ground = scene.objects.emplace_back();
  ground.name = "ground";
  ground.half_space = HalfSpaceBody<double>{{0, 0, 1}, -6};
  return scene;
}

SensorRays random_rays(std::size_t count) {
  SensorRays rays;
  testing::Random random(7);
  for (std::size_t i = 0; i < count; ++i)
    rays.rays.push_back({{5 * random.in_cube(), 2 * random.direction()}, 0});
  return rays;
}

void expect_same(const Scan& a, const Scan& b) {
  ASSERT_EQ(a.echoes.size(), b.echoes.size());
  for (std::size_t i = 0; i < a.echoes.size(); ++i) {
    ASSERT_EQ(a.echoes[i].object, b.echoes[i].object) << i;
    ASSERT_EQ(std::memcmp(&a.echoes[i].t, &b.echoes[i].t, sizeof(double)), 0) << i;
    ASSERT_EQ(a.echoes[i].status, b.echoes[i].status) << i;
  }
}

TEST(Scans, rays_pass_what_no_ray_meets) {
  // A part of alpha 0 of a robot, at rest and moving.
  Scene scene = balls();
  scene.objects.resize(2);
  scene.objects[0].shape = Sphere{2};
  scene.objects[0].visible_to = 0;
  for (Object& object : scene.objects) object.pose.translation = {0, 0, 0};
  SensorRays rays;
  rays.rays.push_back({{{-9, 0, 0}, {1, 0, 0}}, 0});
  for (const bool is_moving : {false, true}) {
    if (is_moving) scene.objects[0].motion = Motion{{PoseKey{}}, {}};
    const Echo echo = scan(scene, rays, {}).echoes.at(0);
    EXPECT_EQ(echo.object, 1);
    EXPECT_EQ(echo.t, 8.5);
  }
}

TEST(Scans, a_ray_answers_what_the_world_answers_it_alone) {
  Scene scene = balls();
  const SensorRays rays = random_rays(5000);
  const Scan result = scan(scene, rays, {});
  const World world = make_world(scene);
  int hits = 0;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    QueryCounts counts;
    const WorldHit hit = world.closest_hit(rays.rays[i].ray, counts);
    const Echo& echo = result.echoes[i];
    ASSERT_EQ(echo.object, hit.found() ? static_cast<int>(hit.instance) : -1);
    if (!hit.found()) {
      EXPECT_EQ(echo.t, std::numeric_limits<double>::infinity());
      continue;
    }
    ++hits;
    EXPECT_EQ(echo.t, hit.cast.t());
    EXPECT_EQ(echo.distance, 2 * echo.t * (rays.rays[i].ray.direction.norm() / 2));
    EXPECT_LE(echo.t_lo, echo.t);
    EXPECT_GE(echo.t_hi, echo.t);
  }
  EXPECT_GT(hits, 2000);
}

TEST(Scans, threads_and_cuts_do_not_change_a_bit) {
  Scene scene = balls();
  const SensorRays rays = random_rays(20000);
  ScanOptions options;
  options.range_noise = 0.01;
  options.angle_noise = 0.002;
  options.dropout = 0.1;
  options.returns = 2;
  Scan one, three;
  with_threads(1, [&] { one = scan(scene, rays, options); });
  with_threads(3, [&] { three = scan(scene, rays, options); });
  expect_same(one, three);
  std::size_t dropped = 0;
  for (const Echo& echo : one.echoes) dropped += echo.status == 3 ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(dropped), 0.1 * static_cast<double>(one.echoes.size()), 300);
  // A part of the rays, if it keeps its numbers.
  SensorRays fewer = rays;
  fewer.rays.resize(7001);
  const Scan part = scan(scene, fewer, options);
  one.echoes.resize(part.echoes.size());
  expect_same(one, part);
}

TEST(Scans, returns_are_the_bodies_behind_each_other) {
  Scene scene;
  scene.materials.push_back({"matt", LambertMaterial{}});
  for (int i = 0; i < 4; ++i) {
    Object& object = scene.objects.emplace_back();
    object.name = "ball";
    object.shape = Sphere();
    object.pose.translation = {3.0 * i, 0, 0};
  }
  scene.objects[2].pose.translation.x() = 4;  // overlaps the second: they are passed as one
  SensorRays rays;
  rays.rays.push_back({{{-5, 0, 0}, {1, 0, 0}}, 0});
  ScanOptions options;
  options.returns = 4;
  const Scan result = scan(scene, rays, options);
  EXPECT_NEAR(result.echoes[0].t, 4, 1e-14);
  EXPECT_NEAR(result.echoes[1].t, 7, 1e-14);
  EXPECT_NEAR(result.echoes[2].t, 13, 1e-14);
  EXPECT_EQ(result.echoes[3].object, -1);
}

TEST(Scans, each_ray_of_a_sweep_sees_the_scene_at_its_own_time) {
  Scene scene;
  scene.materials.push_back({"matt", LambertMaterial{}});
  Object& object = scene.objects.emplace_back();
  object.name = "moving";
  object.shape = Sphere();
  object.motion = Motion{{{0, {0, 0, 0}}, {1, {0, 0, 10}}}, {}};
  SensorRays rays;
  for (int i = 0; i <= 10; ++i) rays.rays.push_back({{{0, 0, -20}, {0, 0, 1}}, (10 - i) / 10.0});
  const Scan result = scan(scene, rays, {});
  for (std::size_t i = 0; i < rays.rays.size(); ++i)
    EXPECT_NEAR(result.echoes[i].t, 19 + 10 * rays.rays[i].time, 1e-12);
  // Mounted on it, a sensor goes along.
  ScanOptions options;
  options.mount = frame_of_object(scene, "moving").value();
  options.pose.translation = {0, 0, 5};
  for (SensorRay& ray : rays.rays) ray.ray = {{0, 0, 0}, {0, 0, -1}};
  const Scan mounted = scan(scene, rays, options);
  for (const Echo& echo : mounted.echoes) EXPECT_NEAR(echo.t, 4, 1e-12);
}

TEST(Scans, rows_of_a_rolling_shutter_are_exposed_one_after_another) {
  Scene scene;
  scene.materials.push_back({"matt", LambertMaterial{}});
  Object& wall = scene.objects.emplace_back();
  wall.name = "wall";
  wall.half_space = HalfSpaceBody<double>{{0, 0, -1}, -10};
  CalibratedCamera::Numbers numbers;
  numbers.fx = numbers.fy = 20, numbers.cx = 2, numbers.cy = 4;
  numbers.width = 5, numbers.height = 9, numbers.row_time = 0.01;
  const SensorRays rays = rays_of_camera(CalibratedCamera(numbers), "k.json");
  ScanOptions options;  // the camera goes ahead with 30 lengths per second
  options.path = MovingFrame{{}, Motion{{{0, {0, 0, 0}}, {1, {0, 0, 30}}}, {}}};
  const Scan result = scan(scene, rays, options);
  for (std::size_t i = 0; i < rays.rays.size(); ++i)
    EXPECT_NEAR(result.echoes[i].t, 10 - 0.3 * double(i / 5), 1e-12) << i;
}

TEST(Scans, noise_has_the_deviation_that_was_asked_for) {
  Scene scene = balls();
  const SensorRays rays = random_rays(20000);
  ScanOptions options;
  const Scan exact = scan(scene, rays, options);
  options.range_noise = 0.02;
  const Scan noisy = scan(scene, rays, options);
  double sum = 0, squares = 0, count = 0;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    if (exact.echoes[i].status != 0) continue;
    const double error = noisy.echoes[i].distance - exact.echoes[i].distance;
    if (noisy.echoes[i].t == 0) continue;
    sum += error;
    squares += error * error;
    ++count;
  }
  EXPECT_LT(std::abs(sum / count), 0.001);
  EXPECT_NEAR(std::sqrt(squares / count), 0.02, 0.0005);
}

TEST(SensorRaysTest, patterns_cameras_and_arrays_are_read) {
  const SensorRays spin = rays_of_pattern("spinning:3x4:-30,30", 0.1);
  ASSERT_EQ(spin.rays.size(), 12u);
  EXPECT_NEAR(spin.rays[0].ray.direction.z(), 0.5, 1e-15);
  EXPECT_NEAR(spin.rays[11].ray.direction.z(), -0.5, 1e-15);
  EXPECT_NEAR(spin.rays[3].time, 0.075, 1e-15);

  const TemporaryFolder folder;
  std::ofstream(folder / "livox.csv")
      << "Time/s,Azimuth/deg,Zenith/deg\n0,0,90\n0.5,90,90\n1,0,0\n";
  const SensorRays livox = rays_of_pattern(folder / "livox.csv", 1);
  ASSERT_EQ(livox.rays.size(), 3u);
  EXPECT_LT((livox.rays[0].ray.direction - Vec3<double>(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((livox.rays[1].ray.direction - Vec3<double>(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((livox.rays[2].ray.direction - Vec3<double>(0, 0, 1)).norm(), 1e-15);
  EXPECT_EQ(livox.rays[1].time, 0.5);

  std::ofstream(folder / "k.json")
      << R"({"fx": 100, "fy": 50, "cx": 2, "cy": 1, "width": 5, "height": 3})";
  const SensorRays camera = rays_of_pinhole(folder / "k.json");
  ASSERT_EQ(camera.rays.size(), 15u);
  EXPECT_EQ(camera.rays[7].ray.direction, Vec3<double>(0, 0, 1));
  EXPECT_EQ(camera.rays[14].ray.direction, Vec3<double>(0.02, 0.02, 1));

  std::string array = npy_header("'<f4'", 2, 6);
  const float numbers[12] = {0, 0, 0, 1, 0, 0, 1, 2, 3, 0, 0, -1};
  array.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
  std::ofstream(folder / "rays.npy", std::ios::binary) << array;
  const SensorRays rays = rays_of_npy(folder / "rays.npy");
  ASSERT_EQ(rays.rays.size(), 2u);
  EXPECT_EQ(rays.rays[1].ray.origin, Vec3<double>(1, 2, 3));
  std::ofstream(folder / "short.npy", std::ios::binary) << array.substr(0, array.size() - 1);
  EXPECT_THROW(rays_of_npy(folder / "short.npy"), BadInput);
}

TEST(SensorPathTest, a_column_is_that_of_its_name_before_one_that_begins_so) {
  const TemporaryFolder folder;
  const auto path = [&](const std::string& text) {
    std::ofstream(folder / "path.csv") << text;
    return read_sensor_path(folder / "path.csv").motion->keys.at(0).translate;
  };
  const auto message = [&](const std::string& text) -> std::string {
    return message_of<BadInput>([&] { path(text); });
  };
  const Vec3<double> expected(4, 5, 6);
  // The deviations were taken for the path.
  EXPECT_EQ(path("time,x_std,y_std,z_std,x,y,z\n0,1,2,3,4,5,6\n"), expected);
  EXPECT_EQ(path("time_ns,Time/s,x1/m,x [m],Y/m,z(m)\n7,0,1,4,5,6\n"), expected);
  EXPECT_EQ(path("timestamp,x_position,y_position,z_position\n0,4,5,6\n"), expected);
  expect_messages(message, {{"time,x_std,x_mean,y,z\n0,1,4,5,6\n",
                             "path.csv: line 1: must name one column x (got 2 and 3, \"xstd\" and "
                             "\"xmean\")"},
                            {"time,x,y,z,X/m\n0,4,5,6,4\n", "must name one column x (got 2 and 5"},
                            {"time,x,y\n0,4,5\n", "line 1: must name the column z"}});
}

TEST(ScanFiles, hold_a_record_of_each_ray) {
  Scene scene = balls();
  const SensorRays rays = rays_of_pattern("spinning:8x50", 0.1);
  const Scan result = scan(scene, rays, {});
  std::size_t points = 0;
  for (const Echo& echo : result.echoes) points += echo.object >= 0 ? 1 : 0;
  ASSERT_GT(points, 100u);
  for (const ScanFormat& format : scan_formats()) {
    const std::vector<unsigned char> bytes = format.encode({result, rays, 1, scene});
    const std::string text(bytes.begin(), bytes.end());
    if (format.ending == ".npy") {
      const std::size_t begin = text.find('\n') + 1;
      EXPECT_EQ(begin % 64, 0u);
      ASSERT_EQ(bytes.size() - begin, 109 * result.echoes.size());
      double t = 0, time = 0;
      std::memcpy(&t, bytes.data() + begin + 109 * 17, sizeof t);
      std::memcpy(&time, bytes.data() + begin + 109 * 17 + 101, sizeof time);
      EXPECT_EQ(t, result.echoes[17].t);
      EXPECT_EQ(time, 0.1 * 17 / 50);
    } else if (format.ending == ".pcd" || format.ending == ".ply") {
      EXPECT_TRUE(has(text, std::to_string(points)));
      const std::string last = format.ending == ".pcd" ? "DATA binary\n" : "end_header\n";
      EXPECT_EQ(bytes.size() - text.find(last) - last.size(), 32 * points);
    } else if (format.ending == ".csv") {
      EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(text, '\n')), 401u);
    } else {
      EXPECT_GT(bytes.size(), 100u);
    }
  }
}

}  // namespace
}  // namespace minkray
