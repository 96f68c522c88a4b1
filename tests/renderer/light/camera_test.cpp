// SPDX-License-Identifier: MIT
#include "renderer/light/camera.h"

#include <gtest/gtest.h>

#include <numbers>

namespace minkray {
namespace {

CameraDescription looking_north() {
  CameraDescription camera;
  camera.position = {1, 2, 3};
  camera.look_at = {1, 7, 3};
  camera.up = {0, 0, 1};
  camera.fov_y_degrees = 60;
  return camera;
}

TEST(Camera, the_middle_of_the_image_looks_at_the_target) {
  const Camera camera(looking_north(), {200, 100});
  const Ray<double> ray = camera.ray(100, 50);
  EXPECT_EQ(ray.origin, Vec3<double>(1, 2, 3));
  EXPECT_NEAR((ray.direction - Vec3<double>(0, 1, 0)).norm(), 0, 1e-15);
}

TEST(Camera, right_is_right_and_down_is_down) {
  const Camera camera(looking_north(), {200, 100});
  EXPECT_GT(camera.ray(150, 50).direction.x(), 0);  // facing north, east is right
  EXPECT_NEAR(camera.ray(150, 50).direction.z(), 0, 1e-15);
  EXPECT_LT(camera.ray(100, 80).direction.z(), 0);
}

TEST(Camera, the_field_of_view_spans_the_height_and_pixels_are_square) {
  const Camera camera(looking_north(), {200, 100});
  const auto angle = [&](double x, double y) {
    return std::acos(camera.ray(x, y).direction.dot(Vec3<double>::UnitY())) * 180 /
           std::numbers::pi;
  };
  EXPECT_NEAR(angle(100, 0), 30, 1e-12);
  EXPECT_NEAR(angle(100, 100), 30, 1e-12);
  EXPECT_NEAR(angle(150, 50), 30, 1e-12);
  EXPECT_NEAR(camera.ray(13, 87).direction.norm(), 1, 1e-15);
}

TEST(Camera, a_point_is_seen_where_its_ray_passes) {
  CameraDescription tilted = looking_north();
  tilted.look_at = {4, 5, -6};
  tilted.up = {0.3, -0.2, 1};
  const Camera camera(tilted, {640, 480});
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(12, 400), Eigen::Vector2d(639.5, 0.5)}) {
    const auto seen = camera.project(camera.ray(pixel.x(), pixel.y()).at(17.0));
    ASSERT_TRUE(seen);
    EXPECT_NEAR((*seen - pixel).norm(), 0, 1e-10);
  }
  EXPECT_FALSE(camera.project(camera.ray(320, 240).at(-1.0)));
}

TEST(Camera, a_useless_up_or_target_still_gives_rays) {
  CameraDescription down = looking_north();
  down.look_at = {1, 2, -9};  // straight down, along up
  CameraDescription nowhere = looking_north();
  nowhere.look_at = nowhere.position;
  CameraDescription without_up = looking_north();
  without_up.up = {0, 0, 0};
  for (const CameraDescription& description : {down, nowhere, without_up}) {
    const Camera camera(description, {64, 64});
    EXPECT_NEAR(camera.ray(3, 60).direction.norm(), 1, 1e-15);
    EXPECT_GT((camera.ray(0, 32).direction - camera.ray(64, 32).direction).norm(), 0.5);
    EXPECT_GT((camera.ray(32, 0).direction - camera.ray(32, 64).direction).norm(), 0.5);
  }
}

}  // namespace
}  // namespace minkray
