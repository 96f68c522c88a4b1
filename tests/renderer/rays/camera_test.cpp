// SPDX-License-Identifier: MIT
#include "renderer/rays/camera.h"

#include <gtest/gtest.h>

#include <numbers>

#include "renderer/rays/sampler.h"
#include "renderer/scene/calibrated_camera.h"

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

CameraDescription camera_of(const char* type) {
  CameraDescription camera;
  camera.position = {1, -4, 2};
  camera.look_at = {1, 0, 2};
  camera.fov_y_degrees = 90;
  camera.type.name = type;
  return camera;
}

TEST(Camera, an_orthographic_one_shows_what_it_looks_at_as_large_as_perspective_does) {
  const Resolution size{200, 100};
  const Camera parallel(camera_of("orthographic"), size), central(camera_of("perspective"), size);
  const Ray<double> ray = parallel.ray(100, 0);
  EXPECT_NEAR((ray.direction - Vec3<double>(0, 1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((ray.origin - Vec3<double>(1, -4, 6)).norm(), 0, 1e-12);
  const Vec3<double> point(3, 0, 1);
  EXPECT_NEAR((*parallel.project(point) - *central.project(point)).norm(), 0, 1e-9);
}

TEST(Camera, fisheyes_spread_angles_or_solid_angles_evenly) {
  const Resolution size{200, 100};
  const auto angle = [&](const char* type, double y) {
    return std::acos(Camera(camera_of(type), size).ray(100, y).direction.y());
  };
  constexpr double pi = std::numbers::pi;
  EXPECT_NEAR(angle("fisheye", 0), pi / 4, 1e-9);
  EXPECT_NEAR(angle("fisheye", 25), pi / 8, 1e-9);
  EXPECT_NEAR(angle("equisolid", 0), pi / 4, 1e-9);
  // A cap's solid angle goes with the square of the sine of half its angle.
  EXPECT_NEAR(std::pow(std::sin(angle("equisolid", 25) / 2) / std::sin(pi / 8), 2), 0.25, 1e-9);
}

TEST(Camera, a_panorama_shows_all_around) {
  const Camera camera(camera_of("panorama"), {200, 100});
  EXPECT_NEAR((camera.ray(100, 50).direction - Vec3<double>(0, 1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((camera.ray(150, 50).direction - Vec3<double>(1, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((camera.ray(0, 50).direction - Vec3<double>(0, -1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((camera.ray(30, 0).direction - Vec3<double>(0, 0, 1)).norm(), 0, 1e-12);
}

TEST(Camera, rays_through_a_lens_meet_where_it_is_in_focus) {
  CameraDescription description = camera_of("perspective");
  description.aperture = 0.6;
  description.focus = 3;
  const Camera camera(description, {200, 100});
  ASSERT_TRUE(camera.has_lens());
  EXPECT_FALSE(Camera(camera_of("perspective"), {200, 100}).has_lens());
  const Ray<double> middle = camera.ray(31, 77);
  const Vec3<double> sharp = middle.at(3 / middle.direction.y());
  double farthest = 0;
  for (int i = 0; i < 64; ++i) {
    const Ray<double> ray = camera.through_lens(middle, {i / 64.0, std::fmod(0.618 * i, 1.0)});
    EXPECT_NEAR((ray.at(3 / ray.direction.y()) - sharp).norm(), 0, 1e-9);
    farthest = std::max(farthest, (ray.origin - middle.origin).norm());
  }
  EXPECT_NEAR(farthest, 0.3, 0.01);
}

TEST(Camera, of_any_type_a_point_is_seen_where_its_ray_passes) {
  for (const char* type : {"perspective", "orthographic", "fisheye", "equisolid", "panorama"}) {
    CameraDescription description;
    description.position = {1, 2, 3};
    description.look_at = {4, 6, 2};
    description.type = {type};
    description.fov_y_degrees = std::string(type) == "fisheye" ? 220 : 100;
    const Camera camera(description, {64, 48});
    for (const double x : {20.5, 31.0, 40.25})
      for (const double y : {10.5, 23.0, 35.75}) {
        const auto seen = camera.seen_at(camera.ray(x, y).at(7.0));
        ASSERT_TRUE(seen) << type;
        EXPECT_NEAR((*seen - Eigen::Vector2d(x, y)).norm(), 0, 1e-9) << type;
      }
  }
}

TEST(Camera, a_fisheye_of_more_than_half_a_turn_sees_what_is_behind_it) {
  CameraDescription description;
  description.position = {0, 0, 0};
  description.look_at = {0, 1, 0};
  description.type = {"fisheye"};
  description.fov_y_degrees = 220;
  const Camera camera(description, {100, 100});
  const Vec3<double> top = camera.ray(50, 0).direction;
  EXPECT_NEAR(std::acos(top.y()) * 180 / std::numbers::pi, 110, 1e-9);
  EXPECT_LT(top.y(), 0);
  EXPECT_GT(top.z(), 0);
}

// Rays leave the lens within the polygon, whose corners are on the round aperture's edge, and
// evenly in each of its triangles.
TEST(Camera, blades_make_the_aperture_a_polygon) {
  CameraDescription description;
  description.position = {0, -5, 0};
  description.aperture = 2;
  for (const int blades : {3, 5, 8}) {
    description.blades = blades;
    const Camera camera(description, {10, 10});
    const Ray<double> middle = camera.ray(4, 7);
    const double inner = std::cos(std::numbers::pi / blades);
    double farthest = 0, squares = 0;
    std::vector<int> sectors(static_cast<std::size_t>(blades));
    constexpr int draws = 1 << 14;
    for (std::uint32_t i = 0; i < draws; ++i) {
      Sampler sampler(2, 0, 0, i);
      const Ray<double> ray = camera.through_lens(middle, sampler.next());
      const Vec3<double> p = ray.origin - middle.origin;
      EXPECT_NEAR(p.y(), 0, 1e-12);
      const double part = std::atan2(p.x(), p.z()) / (2 * std::numbers::pi) * blades + blades;
      ++sectors[static_cast<std::size_t>(part) % sectors.size()];
      const double across = std::hypot(p.x(), p.z()) * std::cos((part - std::floor(part) - 0.5) *
                                                                2 * std::numbers::pi / blades);
      EXPECT_LE(across, inner + 1e-12);
      farthest = std::max(farthest, across);
      squares += across * across / draws;
    }
    EXPECT_GT(farthest, 0.99 * inner);
    EXPECT_NEAR(squares, inner * inner / 2, 0.01);  // as of a triangle's points, by their height
    for (const int count : sectors) EXPECT_NEAR(count, draws / blades, 0.02 * draws);
  }
}

TEST(Camera, of_a_lens_without_distortion_is_perspective) {
  CameraDescription description;
  description.position = {1, -5, 2};
  description.look_at = {0, 0, 0.5};
  description.fov_y_degrees = 50;
  const Resolution half{32, 24};
  const Camera perspective(description, half);
  CalibratedCamera::Numbers numbers;
  numbers.width = 64, numbers.height = 48;  // twice the picture's
  numbers.fx = numbers.fy = 24 / std::tan(25 * std::numbers::pi / 180);
  numbers.cx = 31.5, numbers.cy = 23.5;
  description.calibration = std::make_shared<const CalibratedCamera>(numbers);
  const Camera plain(description, half);
  numbers.k[0] = -0.2;
  description.calibration = std::make_shared<const CalibratedCamera>(numbers);
  const Camera bent(description, half);
  for (double x = 0; x <= 32; x += 4)
    for (double y = 0; y <= 24; y += 3) {
      EXPECT_LT((plain.ray(x, y).direction - perspective.ray(x, y).direction).norm(), 1e-14);
      const auto pixel = bent.seen_at(bent.ray(x, y).at(7));
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - Eigen::Vector2d(x, y)).norm(), 1e-9);
    }
  // A barrel sees more of the world in its corners.
  const auto middle = bent.ray(16, 12).direction;
  EXPECT_LT(bent.ray(0, 0).direction.dot(middle), perspective.ray(0, 0).direction.dot(middle));
  // Beyond the fold of the distortion the last ray is seen.
  numbers.k[0] = -2;
  description.calibration = std::make_shared<const CalibratedCamera>(numbers);
  EXPECT_TRUE(Camera(description, half).ray(0, 0).direction.allFinite());
}

}  // namespace
}  // namespace minkray
