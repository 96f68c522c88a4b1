// SPDX-License-Identifier: MIT
// Firing times of lidars' channels, and scans of moving sensors and scenes by closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "renderer/sensor/scan.h"
#include "renderer/sensor/scan_files.h"
#include "renderer/sensor/sensor_rays.h"

namespace minkray {
namespace {

constexpr double turn = 0.1;

/// Channels of a pattern with one step per turn by the microsecond at which they fire.
std::multimap<long, double> elevations_by_time(const std::string& pattern, double unit) {
  std::multimap<long, double> fired;
  for (const SensorRay& ray : rays_of_pattern(pattern + ":1", turn).rays) {
    const double microseconds = 1e6 * ray.time;
    EXPECT_NEAR(microseconds / unit, std::round(microseconds / unit), 1e-9);
    fired.emplace(std::lround(microseconds / unit),
                  std::asin(ray.ray.direction.z()) * 180 / std::numbers::pi);
  }
  return fired;
}

/// A plane at x = `distance` that faces the origin, with this velocity along x.
Scene wall_at(double distance, double velocity = 0) {
  Scene scene;
  scene.materials.push_back({"matt", LambertMaterial{}});
  Object& wall = scene.objects.emplace_back();
  wall.name = "wall";
  wall.half_space = HalfSpaceBody<double>{{-1, 0, 0}, -distance};
  if (velocity != 0) wall.motion = Motion{{{0, {0, 0, 0}}, {1, {velocity, 0, 0}}}, {}};
  return scene;
}

/// Calls `each` with ray, elevation, azimuth (radians) and time of a VLP-16 by its manual: laser
/// n fires n * 2.304 microseconds after laser 0, at -15 + n degrees if n is even, else at n.
void for_each_ray_of_vlp_16(int steps,
                            const std::function<void(std::size_t, double, double, double)>& each) {
  for (int laser = 0; laser < 16; ++laser) {
    const int elevation = laser % 2 == 0 ? laser - 15 : laser;
    const auto row = static_cast<std::size_t>((15 - elevation) / 2);
    for (int step = 0; step < steps; ++step) {
      const double delay = 2.304e-6 * laser, time = turn * step / steps + delay;
      const double azimuth = std::numbers::pi * (1 - 2 * ((step + 0.5) / steps + delay / turn));
      each(row * static_cast<std::size_t>(steps) + static_cast<std::size_t>(step),
           elevation * std::numbers::pi / 180, azimuth, time);
    }
  }
}

TEST(FiringTimes, of_the_vlp_16_are_one_laser_after_another) {
  const auto fired = elevations_by_time("VLP-16", 2.304);
  ASSERT_EQ(fired.size(), 16u);
  long laser = 0;
  for (const auto& [time, elevation] : fired) {
    EXPECT_EQ(time, laser);
    EXPECT_NEAR(elevation, laser % 2 == 0 ? double(laser) - 15 : double(laser), 1e-12);
    ++laser;
  }
}

TEST(FiringTimes, of_the_vlp_32c_are_pairs_of_lasers) {
  // Follows the manual's table of lasers, from laser 0.
  const double lasers[32] = {-25,    -1,    -1.667, -15.639, -11.31, 0,     -0.667, -8.843,
                             -7.254, 0.333, -0.333, -6.148,  -5.333, 1.333, 0.667,  -4,
                             -4.667, 1.667, 1,      -3.667,  -3.333, 3.333, 2.333,  -2.667,
                             -3,     7,     4.667,  -2.333,  -2,     15,    10.333, -1.333};
  const auto fired = elevations_by_time("VLP-32C", 2.304);
  ASSERT_EQ(fired.size(), 32u);
  for (int pair = 0; pair < 16; ++pair) {
    ASSERT_EQ(fired.count(pair), 2u) << pair;
    const double a = fired.find(pair)->second, b = std::next(fired.find(pair))->second;
    EXPECT_NEAR(std::max(a, b), std::max(lasers[2 * pair], lasers[2 * pair + 1]), 1e-9);
    EXPECT_NEAR(std::min(a, b), std::min(lasers[2 * pair], lasers[2 * pair + 1]), 1e-9);
  }
}

TEST(FiringTimes, of_the_hdl_64e_are_those_of_its_two_blocks) {
  // Lasers 0, 1, 2, 3, 4 and 31 of the lower elevations' numbering, and 32 more: both blocks.
  const auto fired = elevations_by_time("HDL-64E", 0.02);
  ASSERT_EQ(fired.size(), 64u);
  const struct {
    double microseconds, a, b;
  } lasers[] = {{0, -7.16, -22.74}, {1.26, -6.82, -22.23}, {2.46, 0.32, -11.51},
                {3.66, 0.66, -11},  {6, -6.48, -21.71},    {45.66, -0.02, -12.03}};
  for (const auto& laser : lasers) {
    const long time = std::lround(laser.microseconds / 0.02);
    ASSERT_EQ(fired.count(time), 2u) << laser.microseconds;
    const double a = fired.find(time)->second, b = std::next(fired.find(time))->second;
    EXPECT_NEAR(std::max(a, b), laser.a, 1e-9);
    EXPECT_NEAR(std::min(a, b), laser.b, 1e-9);
  }
  for (auto at = fired.begin(); at != fired.end(); at = fired.upper_bound(at->first))
    EXPECT_EQ(fired.count(at->first), 2u);
}

TEST(FiringTimes, of_the_os1_are_those_of_its_columns) {
  EXPECT_EQ(elevations_by_time("OS1-64", 1).count(0), 64u);
}

TEST(FiringTimes, move_each_ray_of_a_sensor_that_drives_to_a_wall) {
  constexpr int steps = 90;
  constexpr double distance = 30, speed = 20;
  const SensorRays rays = rays_of_pattern("VLP-16:90", turn);
  ScanOptions options;
  options.path = MovingFrame{{}, Motion{{{0, {0, 0, 0}}, {1, {speed, 0, 0}}}, {}}};
  const Scan driven = scan(wall_at(distance), rays, options);
  const Scan driven_at = scan(wall_at(distance, -speed), rays, {});
  int hits = 0;
  for_each_ray_of_vlp_16(
      steps, [&](std::size_t ray, double elevation, double azimuth, double time) {
        const double share = std::cos(elevation) * std::cos(azimuth);
        EXPECT_EQ(driven.echoes[ray].status, share > 0 ? 0 : 1);
        if (!(share > 0)) return;
        ++hits;
        const double exact = (distance - speed * time) / share;
        EXPECT_NEAR(driven.echoes[ray].distance, exact, 1e-13 * exact / share);
        EXPECT_NEAR(driven.echoes[ray].point.x(), distance, 1e-12);
        EXPECT_NEAR(driven_at.echoes[ray].distance, exact, 1e-13 * exact / share);
        EXPECT_NEAR(driven_at.echoes[ray].point.x(), distance - speed * time, 1e-12);
      });
  EXPECT_NEAR(hits, 16 * steps / 2, 16);  // one ray per channel may be along the wall
  // 15 lasers later the sensor is 0.69 millimetres nearer: far beyond the tolerance above.
  EXPECT_NEAR(speed * rays.rays[0].time, 6.9e-4, 2e-6);
}

TEST(FiringTimes, turn_each_ray_of_a_sensor_that_turns) {
  constexpr int steps = 90;
  constexpr double distance = 5, angle = 0.5;  // radians in the second of the path
  const SensorRays rays = rays_of_pattern("VLP-16:90", turn);
  PoseKey begin, end;
  begin.time = 0, end.time = 1;
  end.rotate = {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
  ScanOptions options;
  options.path = MovingFrame{{}, Motion{{begin, end}, {}}};
  options.start = 0.25;
  const Scene scene = wall_at(distance);
  const Scan turned = scan(scene, rays, options);
  const ScanOutput output{turned, rays, 1, scene, options.start};
  for_each_ray_of_vlp_16(steps, [&](std::size_t ray, double elevation, double azimuth,
                                    double time) {
    EXPECT_NEAR(output.time_of(ray), 0.25 + time, 1e-15);
    const double share = std::cos(elevation) * std::cos(azimuth + angle * (0.25 + time));
    EXPECT_EQ(turned.echoes[ray].status, share > 0 ? 0 : 1);
    if (!(share > 0)) return;
    EXPECT_NEAR(turned.echoes[ray].distance, distance / share, 1e-13 * distance / (share * share));
  });
}

}  // namespace
}  // namespace minkray
