// SPDX-License-Identifier: MIT
// Calibrated cameras against OpenCV's formulas, written forwards.
#include "renderer/scene/calibrated_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "renderer/base/errors.h"
#include "renderer/json/json.h"
#include "renderer/sensor/sensor_rays.h"
#include "tests/support/expect_exit.h"
#include "tests/support/random.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

using Numbers = CalibratedCamera::Numbers;

/// projectPoints of OpenCV's page on calib3d, in long double.
Eigen::Vector2d by_opencv(const Numbers& n, const Vec3<double>& point) {
  const long double x = (long double)point.x() / point.z(), y = (long double)point.y() / point.z();
  const long double r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const long double radial =
      (1 + n.k[0] * r2 + n.k[1] * r4 + n.k[2] * r6) / (1 + n.k[3] * r2 + n.k[4] * r4 + n.k[5] * r6);
  const long double u = x * radial + 2 * n.p1 * x * y + n.p2 * (r2 + 2 * x * x);
  const long double v = y * radial + n.p1 * (r2 + 2 * y * y) + 2 * n.p2 * x * y;
  return {double(n.fx * u + n.cx), double(n.fy * v + n.cy)};
}

/// fisheye::projectPoints of the same page.
Eigen::Vector2d by_opencv_fisheye(const Numbers& n, const Vec3<double>& point) {
  const long double a = (long double)point.x() / point.z(), b = (long double)point.y() / point.z();
  const long double r = std::sqrt(a * a + b * b), angle = std::atan(r);
  const long double distorted =
      angle * (1 + n.k[0] * std::pow(angle, 2) + n.k[1] * std::pow(angle, 4) +
               n.k[2] * std::pow(angle, 6) + n.k[3] * std::pow(angle, 8));
  return {double(n.fx * distorted / r * a + n.cx), double(n.fy * distorted / r * b + n.cy)};
}

Numbers pinhole(std::array<double, 6> k, double p1, double p2) {
  Numbers n;
  n.fx = 520, n.fy = 515, n.cx = 318.7, n.cy = 242.2, n.width = 640, n.height = 480;
  n.k = k, n.p1 = p1, n.p2 = p2;
  return n;
}

/// A webcam, a wide lens (TUM's fr1), a rational model as OpenCV's calibration of a phone gives it.
const Numbers pinholes[] = {pinhole({}, 0, 0), pinhole({-0.28, 0.07, 0, 0, 0, 0}, 1e-3, -4e-4),
                            pinhole({0.2624, -0.9531, 1.1633, 0, 0, 0}, -0.0054, 0.0026),
                            pinhole({5.1, 2.4, 0.11, 5.4, 4.0, 0.62}, 1e-4, -2e-4)};

TEST(CalibratedCameras, project_points_as_opencv_does) {
  testing::Random random(3);
  for (const Numbers& n : pinholes) {
    const CalibratedCamera camera(n);
    for (int i = 0; i < 2000; ++i) {
      const Vec3<double> cube = random.in_cube();
      const Vec3<double> point(0.5 * cube.x(), 0.4 * cube.y(), 1 + 0.2 * cube.z());
      const auto pixel = camera.project(point);
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - by_opencv(n, point)).norm(), 1e-9);
    }
    EXPECT_FALSE(camera.project({0, 0, -1}));
  }
}

TEST(CalibratedCameras, rays_go_to_the_points_that_their_pixels_show) {
  for (const Numbers& n : pinholes) {
    const CalibratedCamera camera(n);
    int rays = 0;
    for (int v = 0; v < n.height; v += 7)
      for (int u = 0; u < n.width; u += 7) {
        const auto direction = camera.direction(u, v);
        if (!direction) continue;
        ++rays;
        EXPECT_EQ(direction->z(), 1);
        EXPECT_LT((by_opencv(n, *direction) - Eigen::Vector2d(u, v)).norm(), 1e-9) << u << " " << v;
      }
    EXPECT_EQ(rays, 92 * 69);
  }
}

TEST(CalibratedCameras, fisheyes_see_beyond_the_half_space_ahead) {
  Numbers n;
  n.model = CalibratedCamera::Model::fisheye;
  n.fx = 285, n.fy = 286, n.cx = 425.4, n.cy = 399.8, n.width = 848, n.height = 800;
  n.k = {-0.0067, 0.0423, -0.0400, 0.0071, 0, 0};  // a RealSense T265's
  const CalibratedCamera camera(n);
  testing::Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const Vec3<double> cube = random.in_cube();
    const Vec3<double> point(3 * cube.x(), 3 * cube.y(), 1.01 + cube.z());
    const auto pixel = camera.project(point);
    ASSERT_TRUE(pixel);
    EXPECT_LT((*pixel - by_opencv_fisheye(n, point)).norm(), 1e-9);
    const auto direction = camera.direction(pixel->x(), pixel->y());
    ASSERT_TRUE(direction);
    EXPECT_LT((*direction - unit(point)).norm(), 1e-11);
  }
  n.k = {};
  const CalibratedCamera equidistant(n);
  const auto behind = equidistant.direction(n.cx + n.fx * 2, n.cy);
  ASSERT_TRUE(behind);
  EXPECT_LT((*behind - Vec3<double>(std::sin(2), 0, std::cos(2))).norm(), 1e-14);
  EXPECT_FALSE(equidistant.direction(n.cx + n.fx * 3.2, n.cy));  // beyond half a turn
}

TEST(CalibratedCameras, pixels_beyond_the_fold_of_the_distortion_have_no_ray) {
  // r (1 - 0.3 r^2) grows up to r = sqrt(1 / 0.9), where it is 2/3 of that.
  Numbers n = pinhole({-0.3, 0, 0, 0, 0, 0}, 0, 0);
  n.fx = n.fy = 100, n.cx = n.cy = 0, n.width = 90, n.height = 2, n.row_time = 1e-3;
  const CalibratedCamera camera(n);
  const double fold = std::sqrt(1 / 0.9);
  EXPECT_NEAR(camera.reach(), fold, 1e-9);
  const double last = 100 * fold * 2 / 3;
  EXPECT_TRUE(camera.direction(last - 1e-3, 0));
  EXPECT_FALSE(camera.direction(last + 1e-3, 0));
  EXPECT_FALSE(camera.project({1.2, 0, 1}));
  const SensorRays rays = rays_of_camera(camera, "k.json");
  EXPECT_EQ(rays.missing, 2 * (90 - std::size_t(std::ceil(last))));
  EXPECT_EQ(rays.rays[90].time, 1e-3);  // the second row
  n.fx = 1e-310;                        // beyond all numbers
  EXPECT_FALSE(CalibratedCamera(n).direction(1, 0));
  n.k[0] = 0;
  EXPECT_FALSE(CalibratedCamera(n).direction(1, 0));
  n.fx = 100, n.k[0] = -0.3, n.cx = -100;
  EXPECT_THROW(rays_of_camera(CalibratedCamera(n), "k.json"), BadInput);
}

TEST(CalibratedCameras, are_read_with_all_mistakes_told) {
  const std::string rest = R"("fx": 1, "fy": 1, "cx": 0, "cy": 0, "width": 4, "height": 3)";
  const CalibratedCamera camera = parse_calibrated_camera(
      "{" + rest + R"(, "k1": 0.1, "p2": 0.2, "row_time": 1e-5})", "k.json");
  EXPECT_EQ(camera.numbers().k[0], 0.1);
  EXPECT_EQ(camera.numbers().p2, 0.2);
  EXPECT_EQ(camera.numbers().row_time, 1e-5);
  const std::string text =
      "{" + rest + R"(, "model": "fisheye", "p1": 0, "k5": 1, "row_time": -1})";
  expect_parts(
      message_of<BadInput>([&] { parse_calibrated_camera(text, "k.json"); }),
      {"k.json: /p1: unknown key", "k.json: /k5: unknown key", "k.json: /row_time: must be >= 0"});
  EXPECT_THROW(parse_calibrated_camera("{" + rest + R"(, "model": "ball"})", "k.json"), BadInput);
}

// The scene's own lens sees 20 degrees, the calibrated one more than 60 to each side.
TEST(CalibratedCameras, trace_and_inspect_cast_their_rays) {
  const TemporaryFolder folder;
  std::ofstream(folder / "s.json") << R"({"version": 2,
    "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0], "fov_y_degrees": 20},
    "objects": [{"name": "ahead", "shape": {"type": "sphere", "radius": 0.5}},
                {"name": "aside", "shape": {"type": "sphere", "radius": 0.5},
                 "transform": {"translate": [6, -1, 0]}}]})";
  std::ofstream(folder / "k.json") << R"({"model": "fisheye", "fx": 20, "fy": 21, "cx": 31.5,
    "cy": 23.25, "width": 64, "height": 48, "k1": -0.01})";
  const std::string words = folder / "s.json" + " --camera-file " + folder / "k.json";
  const Vec3<double> seen =
      unit(*read_calibrated_camera(folder / "k.json").direction(51, 24));  // x right, y down
  const ProgramOutcome traced = run_minkray("trace " + words + " --pixel 51,24 --json");
  ASSERT_EQ(traced.exit_code, 0) << traced.err;
  const Json json = Json::parse(traced.out);
  const Vec3<double> in_world(seen.x(), seen.z(), -seen.y());
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(json.at("direction")[std::size_t(i)].get<double>(), in_world[i], 1e-15);
  EXPECT_EQ(json.at("object").get<std::string>(), "aside");
  EXPECT_EQ(json.at("status").get<std::string>(), "hit");
  expect_exit(2, run_minkray("trace " + words + " --pixel 64,24"), {"63,47"});

  const std::string page = folder / "p.html";
  const ProgramOutcome inspected = run_minkray("inspect " + words + " -s 1 -q -o " + page);
  ASSERT_EQ(inspected.exit_code, 0) << inspected.err;
  const std::string html = text_of_file(page);
  expect_parts(html, {"\"resolution\":[64,48]", "\"names\":{\"1\":\"ahead\",\"2\":\"aside\"}"});
}

}  // namespace
}  // namespace minkray
