// SPDX-License-Identifier: MIT
// Patterns of lidars: by name, over a range of azimuths, and from files.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "renderer/base/errors.h"
#include "renderer/sensor/lidar_models.h"
#include "renderer/sensor/ray_directions.h"
#include "renderer/sensor/sensor_rays.h"
#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

double degrees(double angle) {
  return angle * 180 / std::numbers::pi;
}
double azimuth(const SensorRay& ray) {
  return degrees(std::atan2(ray.ray.direction.y(), ray.ray.direction.x()));
}
double elevation(const SensorRay& ray) {
  return degrees(std::asin(ray.ray.direction.z()));
}

template <class Error>
std::string message(const std::string& pattern) {
  return message_of<Error>([&] { rays_of_pattern(pattern, 0.1); });
}

TEST(Lidars, have_the_channels_of_their_data_sheets) {
  const struct {
    const char* name;
    int channels, steps;
    double highest, lowest, last_delay;
  } sheets[] = {{"VLP-16", 16, 1800, 15, -15, 0},
                {"vlp32c", 32, 1800, 15, -25, 0},
                {"OS1_64", 64, 1024, 21.02, -21.41, 0},
                {"hdl-64e", 64, 2083, 2.02, -24.71, 8.46e-6}};
  for (const auto& sheet : sheets) {
    const SensorRays rays = rays_of_pattern(sheet.name, 0.1);
    EXPECT_EQ(rays.height, sheet.channels) << sheet.name;
    EXPECT_EQ(rays.width, sheet.steps);
    ASSERT_EQ(rays.rays.size(), std::size_t(sheet.channels * sheet.steps));
    EXPECT_NEAR(elevation(rays.rays.front()), sheet.highest, 1e-9);
    EXPECT_NEAR(elevation(rays.rays.back()), sheet.lowest, 1e-9);
    EXPECT_NEAR(rays.rays.back().time, 0.1 * (1 - 1.0 / sheet.steps) + sheet.last_delay, 1e-15);
  }
  // Channels of one step point to different sides: the VLP-32C's by 1.4 and 4.2 degrees.
  const SensorRays rays = rays_of_pattern("VLP-32C:4", 0.1);
  std::multiset<long> offsets;
  for (std::size_t i = 0; i < rays.rays.size(); i += 4)
    offsets.insert(std::lround(10 * (azimuth(rays.rays[i]) - 135 + 3600 * rays.rays[i].time)));
  for (const long offset : {-42, -14, 14, 42})
    EXPECT_EQ(offsets.count(offset), std::labs(offset) == 14 ? 11u : 5u) << offset;
}

TEST(Lidars, that_are_unknown_are_told_the_names) {
  EXPECT_TRUE(has(message<WrongUsage>("VLP-17"), "did you mean \"VLP-16\"?"));
  const std::string all = message<WrongUsage>("blickfeld");
  for (const LidarModel& model : lidar_models()) EXPECT_TRUE(has(all, model.name));
  EXPECT_TRUE(has(message<WrongUsage>("VLP-16:0"), "VLP-16:STEPS"));
  EXPECT_TRUE(has(message<WrongUsage>("VLP-16:1.5"), "(got :1.5)"));
  EXPECT_TRUE(has(message<WrongUsage>("Mid-360:1e12"), "Mid-360:RAYS"));
  EXPECT_TRUE(has(message<BadInput>("missing.csv"), "missing.csv"));
}

TEST(Lidars, the_mid_360_covers_its_field_of_view_and_does_not_repeat) {
  const SensorRays first = rays_of_pattern("Mid-360", 0.1),
                   next = rays_of_pattern("mid360", 0.1, 0.1);
  ASSERT_EQ(first.rays.size(), 20000u);
  EXPECT_NEAR(first.rays[1].time, 5e-6, 1e-18);
  // Rows of Livox's mid360.csv, from 1, of the first turn: azimuth and zenith in degrees, within
  // the documented error.
  const struct {
    std::size_t row;
    double azimuth, zenith;
  } table[] = {{1, 268.99, 37.838},   {2, 269, 40.825},      {3, 269, 43.581},
               {4, 269, 46.152},      {297, 179.11, 42.875}, {540, 101.26, 38.724},
               {577, 86.704, 46.885}, {848, 6.4632, 44.292}};
  for (const auto& row : table) {
    const SensorRay& ray = first.rays[row.row - 1];
    EXPECT_LT(std::abs(std::remainder(azimuth(ray) - row.azimuth, 360)), 10) << row.row;
    EXPECT_NEAR(90 - elevation(ray), row.zenith, 2) << row.row;
  }
  // The mean of its four lines later on.
  const SensorRays long_frame = rays_of_pattern("Mid-360:50000", 0.1);
  for (const auto& [row, zenith] :
       {std::pair{13105, 81.4}, {25681, 73.9}, {37893, 52.3}, {49901, 94.1}}) {
    double mean = 0;
    for (int line = 0; line < 4; ++line)
      mean += (90 - elevation(long_frame.rays[std::size_t(row - 1 + line)])) / 4;
    EXPECT_NEAR(mean, zenith, 5.5) << row;
  }
  double highest = -90, lowest = 90;
  std::set<std::pair<int, int>> cells, more;
  for (const SensorRays* frame : {&first, &next})
    for (const SensorRay& ray : frame->rays) {
      highest = std::max(highest, elevation(ray));
      lowest = std::min(lowest, elevation(ray));
      const std::pair cell(int(std::floor(azimuth(ray))), int(std::floor(elevation(ray))));
      more.insert(cell);
      if (frame == &first) cells.insert(cell);
    }
  EXPECT_NEAR(highest, 52, 0.5);
  EXPECT_NEAR(lowest, -7, 0.5);
  // The second frame meets places that the first one left out: cells of one degree.
  EXPECT_GT(more.size(), 5 * cells.size() / 4);
  int same = 0;
  for (std::size_t i = 0; i < first.rays.size(); ++i)
    same += (first.rays[i].ray.direction - next.rays[i].ray.direction).norm() < 1e-6 ? 1 : 0;
  EXPECT_LT(same, 10);
}

TEST(Lidars, a_range_of_azimuths_has_rays_at_both_ends) {
  const SensorRays rays = rays_of_pattern("spinning:1x1081:0,0:-135,135", 0.025);
  ASSERT_EQ(rays.rays.size(), 1081u);
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    EXPECT_NEAR(azimuth(rays.rays[i]), -135 + 0.25 * double(i), 1e-11);
    EXPECT_NEAR(rays.rays[i].time, 0.025 * 0.75 * double(i) / 1080, 1e-15);
  }
  for (const char* wrong : {"spinning:1x2:0,0:-200,200", "spinning:1x2:0,0:0",
                            "spinning:1x2:1,0:0,1", "spinning:1x2:0,0:0,1:2", "spinning:0x2"})
    EXPECT_TRUE(has(message<WrongUsage>(wrong), ":FROM,TO")) << wrong;
}

TEST(Lidars, are_read_from_files) {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
    return std::string(folder / name);
  };
  const SensorRays own = rays_of_pattern(
      write("a.json", R"({"elevations": [10, -5], "azimuths": [0, 2], "steps": 4})"), 0.1);
  ASSERT_EQ(own.rays.size(), 8u);
  EXPECT_NEAR(elevation(own.rays[0]), 10, 1e-12);
  EXPECT_NEAR(azimuth(own.rays[4]), 137, 1e-12);
  // The second channel fires a hundredth of a turn after the first one.
  const SensorRays timed = rays_of_pattern(
      write("t.json", R"({"elevations": [10, -5], "firing_times": [0, 1e-3], "steps": 4})"), 0.1);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(timed.rays[i].time, 0.025 * double(i), 1e-17);
    EXPECT_NEAR(timed.rays[4 + i].time, 0.025 * double(i) + 1e-3, 1e-17);
    EXPECT_NEAR(azimuth(timed.rays[4 + i]), 135 - 90 * double(i) - 3.6, 1e-11);
  }
  // Ouster counts azimuths clockwise, in files old and new.
  const std::string beams = R"("beam_altitude_angles": [1], "beam_azimuth_angles": [3])";
  for (const std::string& text :
       {"{" + beams + R"(, "lidar_mode": "512x10"})",
        R"({"beam_intrinsics": {)" + beams + R"(}, "config_params": {"lidar_mode": "512x20"}})"}) {
    const SensorRays ouster = rays_of_pattern(write("o.json", text), 0.1);
    EXPECT_EQ(ouster.width, 512);
    EXPECT_NEAR(azimuth(ouster.rays[0]), 180 - 180.0 / 512 - 3, 1e-11);
  }
  // A pose of RobotecGPULidar: its z axis along y, its origin at (1, 2, 3).
  const float pose[12] = {1, 0, 0, 1, 0, 0, 2, 2, 0, 1, 0, 3};
  const std::string bytes(reinterpret_cast<const char*>(pose), sizeof pose);
  const SensorRays poses = rays_of_pattern(write("p.mat3x4f", bytes + bytes), 0.1);
  ASSERT_EQ(poses.rays.size(), 2u);
  EXPECT_EQ(poses.rays[1].ray.origin, Vec3<double>(1, 2, 3));
  EXPECT_EQ(poses.rays[1].ray.direction, Vec3<double>(0, 1, 0));

  const auto refused = [&](const char* name, const std::string& text) {
    return message<BadInput>(write(name, text));
  };
  EXPECT_TRUE(has(refused("p.mat3x4f", bytes.substr(1)), "got 47 bytes"));
  EXPECT_TRUE(has(refused("p.mat3x4f", std::string(48, '\0')), "pose 0 must"));
  EXPECT_TRUE(
      has(refused("a.json", R"({"elevations": [99], "steps": 4})"), "/elevations/0: must be "));
  EXPECT_TRUE(has(refused("a.json", R"({"elevations": [9], "steps": 0})"), "/steps"));
  EXPECT_TRUE(has(refused("a.json", R"({"elevations": [9], "azimuths": [1, 2], "steps": 1})"),
                  "as many azimuths as elevations (got 2 and 1)"));
  EXPECT_TRUE(has(refused("a.json", R"({"elevations": [9], "firing_times": [0, 0], "steps": 1})"),
                  "as many firing_times as elevations (got 2 and 1)"));
  EXPECT_TRUE(has(refused("a.json", R"({"elevations": [9], "firing_times": [-1], "steps": 1})"),
                  "/firing_times/0: must be from 0 to 1 seconds"));
  EXPECT_TRUE(has(refused("a.json", R"({"beam_altitude_angles": [1]})"), "/lidar_mode"));
}

}  // namespace
}  // namespace minkray
