// SPDX-License-Identifier: MIT
// Measurements of lidars at walls, by closed forms: ranges, intensities, echoes at edges.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/sensor/beam.h"
#include "renderer/sensor/scan.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

/// A wall at x = 10 of reflectance 0.4 and, before its half y < 0, one at x = 6 of 0.8.
Scene two_walls() {
  Scene scene;
  scene.materials.push_back({"grey", LambertMaterial{Colour::Constant(0.4)}});
  scene.materials.push_back({"light", LambertMaterial{Colour::Constant(0.8)}});
  scene.materials.push_back({"glass", DielectricMaterial{}});
  Object& far = scene.objects.emplace_back();
  far.name = "far";
  far.half_space = HalfSpaceBody<double>{{-1, 0, 0}, -10};
  Object& near = scene.objects.emplace_back();
  near.name = "near";
  near.material = 1;
  Box box;
  box.half_extents = {0.5, 100, 100};
  near.shape = box;
  near.pose.translation = {6.5, -100, 0};
  return scene;
}

SensorRays towards(std::initializer_list<Vec3<double>> directions) {
  SensorRays rays;
  for (const Vec3<double>& direction : directions) rays.rays.push_back({{{0, 0, 0}, direction}, 0});
  return rays;
}

TEST(Echoes, of_a_wall_are_as_bright_as_lamberts_law_says) {
  Scene scene = two_walls();
  SensorRays rays;
  for (int degrees = 1; degrees < 80; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    rays.rays.push_back({{{0, 0, 0}, {3 * std::cos(angle), 3 * std::sin(angle), 0}}, 0});
  }
  const Scan result = scan(scene, rays, {});
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const double angle = double(i + 1) * std::numbers::pi / 180, range = 10 / std::cos(angle);
    EXPECT_NEAR(result.echoes[i].distance, range, 1e-12 * range);
    EXPECT_NEAR(result.echoes[i].incidence, angle, 1e-7);
    EXPECT_NEAR(result.echoes[i].intensity, 0.4 * std::cos(angle) / (range * range), 1e-9);
  }
  scene.objects[0].material = 2;  // glass sends nothing back
  EXPECT_EQ(scan(scene, rays, {}).echoes[5].intensity, 0);
}

TEST(Echoes, are_within_the_limits_of_range) {
  const Scene scene = two_walls();
  const SensorRays rays = towards({{1, -1e-3, 0}, {2, 1e-3, 0}});
  ScanOptions options;
  options.returns = 2;
  Scan result = scan(scene, rays, options);
  EXPECT_NEAR(result.echoes[0].distance, 6, 1e-5);
  EXPECT_NEAR(result.echoes[1].distance, 10, 1e-4);
  options.farthest = 9;
  result = scan(scene, rays, options);
  EXPECT_EQ(result.echoes[0].status, 0);
  EXPECT_EQ(result.echoes[1].status, 1);
  EXPECT_EQ(result.echoes[2].status, 1);
  options.nearest = 7;
  result = scan(scene, rays, options);
  EXPECT_EQ(result.echoes[0].status, 4);
  EXPECT_EQ(result.echoes[0].object, -1);
  EXPECT_EQ(result.echoes[2].status, 1);
}

TEST(Echoes, come_in_the_order_that_was_asked_for) {
  Scene scene = two_walls();
  const SensorRays rays = towards({{1, -1e-3, 0}});
  ScanOptions options;
  EXPECT_EQ(scan(scene, rays, options).echoes[0].object, 1);
  options.order = EchoOrder::last;
  EXPECT_EQ(scan(scene, rays, options).echoes[0].object, 0);
  options.order = EchoOrder::strongest;
  EXPECT_EQ(scan(scene, rays, options).echoes[0].object, 1);  // 0.8 / 36 > 0.4 / 100
  scene.materials[1].kind = LambertMaterial{Colour::Constant(0.1)};
  EXPECT_EQ(scan(scene, rays, options).echoes[0].object, 0);  // 0.1 / 36 < 0.4 / 100
}

TEST(Echoes, noise_grows_with_the_range) {
  const Scene scene = two_walls();
  SensorRays rays;
  for (int i = 0; i < 20000; ++i)
    rays.rays.push_back({{{0, 0, 0}, {1, i % 2 ? 1e-9 : -1e-9, 0}}, 0});
  ScanOptions options;
  options.range_noise = 0.01;
  options.range_noise_per_length = 0.002;
  const Scan result = scan(scene, rays, options);
  double squares[2] = {};
  for (std::size_t i = 0; i < rays.rays.size(); ++i)
    squares[i % 2] += std::pow(result.echoes[i].distance - (i % 2 ? 10 : 6), 2);
  EXPECT_NEAR(std::sqrt(squares[0] / 10000), 0.01 + 0.002 * 6, 0.0006);
  EXPECT_NEAR(std::sqrt(squares[1] / 10000), 0.01 + 0.002 * 10, 0.0008);
}

/// The share of a disk of radius 1 beyond a line at distance c from its middle.
double share_beyond(double c) {
  c = std::clamp(c, -1.0, 1.0);
  return (std::acos(c) - c * std::sqrt(1 - c * c)) / std::numbers::pi;
}

TEST(Beams, rays_share_the_disk_as_evenly_as_is_said) {
  for (const int count : {7, 19, 37, 100, 400}) {
    const auto directions = directions_of_beam({0, 0, 2}, 0.02, count);
    ASSERT_EQ(directions.size(), std::size_t(count));
    const double radius = std::tan(0.01);
    double worst = 0;
    for (int turn = 0; turn < 60; ++turn) {
      const double a = turn * std::numbers::pi / 30;
      for (double c = -1; c <= 1; c += 0.01) {
        int beyond = 0;
        for (const Vec3<double>& d : directions) {
          EXPECT_NEAR(d.norm(), 2, 1e-15);
          const double x = (d.x() * std::cos(a) + d.y() * std::sin(a)) / d.z() / radius;
          beyond += x > c ? 1 : 0;
        }
        worst = std::max(worst, std::abs(double(beyond) / count - share_beyond(c)));
      }
    }
    EXPECT_LT(worst, std::pow(count, -2.0 / 3)) << count;
    EXPECT_GT(worst, 0.3 * std::pow(count, -2.0 / 3)) << count;  // the bound is no joke
  }
}

TEST(Beams, at_an_edge_have_two_echoes_that_share_the_light) {
  const Scene scene = two_walls();
  ScanOptions options;
  options.divergence = 0.01;
  options.beam_rays = 400;
  options.returns = 3;
  const double radius = 6 * std::tan(0.005);
  for (const double offset : {-0.7, -0.2, 0.0, 0.3, 0.8}) {
    // The beam's middle passes the edge at y = 0, x = 6, by `offset` of the beam's radius there.
    const SensorRays rays = towards({{6, offset * radius, 0}});
    const Scan result = scan(scene, rays, options);
    const Echo &first = result.echoes[0], &second = result.echoes[1];
    const double near = share_beyond(offset), error = std::pow(400, -2.0 / 3);
    ASSERT_EQ(first.object, 1);
    ASSERT_EQ(second.object, 0);
    EXPECT_EQ(result.echoes[2].object, -1);
    EXPECT_NEAR(first.intensity * 36 / 0.8, near, error + 1e-3);
    EXPECT_NEAR(second.intensity * 100 / 0.4, 1 - near, error + 1e-3);
    EXPECT_NEAR(first.distance, 6, 3e-4);
    EXPECT_NEAR(second.distance, 10, 5e-4);
    // The order and the number that are kept.
    options.returns = 1;
    options.order = EchoOrder::last;
    EXPECT_EQ(scan(scene, rays, options).echoes[0].object, 0);
    options.order = EchoOrder::strongest;
    EXPECT_EQ(scan(scene, rays, options).echoes[0].object,
              0.8 / 36 * near > 0.4 / 100 * (1 - near) ? 1 : 0);
    // Hits nearer to each other than the resolution are one echo, at the mean by intensity.
    options.resolution = 5;
    options.order = EchoOrder::first;
    const Echo mixed = scan(scene, rays, options).echoes[0];
    const double a = first.intensity, b = second.intensity;
    EXPECT_NEAR(mixed.distance, (a * first.distance + b * second.distance) / (a + b), 1e-9);
    EXPECT_NEAR(mixed.intensity, a + b, 1e-15);
    options.resolution = 0.5;
    options.returns = 3;
  }
}

}  // namespace
}  // namespace minkray
