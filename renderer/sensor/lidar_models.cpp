// SPDX-License-Identifier: MIT
#include "renderer/sensor/lidar_models.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/files/text.h"

namespace minkray {
namespace {

/// Laser of a spinning lidar: angles as of LidarChannel, and its number in the order of firing.
struct Laser {
  double elevation, azimuth;
  int number;
};

/// Channels of lasers, where microseconds(number) is a laser's delay.
template <std::size_t count, class Microseconds>
consteval std::array<LidarChannel, count> fired(const Laser (&lasers)[count],
                                                Microseconds microseconds) {
  std::array<LidarChannel, count> channels{};
  for (std::size_t i = 0; i < count; ++i)
    channels[i] = {lasers[i].elevation, lasers[i].azimuth, 1e-6 * microseconds(lasers[i].number)};
  return channels;
}

/// Velodyne's VLP-16: the angles of its manual, 2 degrees apart; ros-drivers/velodyne VLP16db.yaml.
constexpr Laser vlp_16_lasers[] = {
    {15.0, 0.0, 15}, {13.0, 0.0, 13}, {11.0, 0.0, 11}, {9.0, 0.0, 9},
    {7.0, 0.0, 7},   {5.0, 0.0, 5},   {3.0, 0.0, 3},   {1.0, 0.0, 1},
    {-1.0, 0.0, 14}, {-3.0, 0.0, 12}, {-5.0, 0.0, 10}, {-7.0, 0.0, 8},
    {-9.0, 0.0, 6},  {-11.0, 0.0, 4}, {-13.0, 0.0, 2}, {-15.0, 0.0, 0}};

/// One laser after another; user manual 63-9243, section 9.4.
constexpr auto vlp_16 = fired(vlp_16_lasers, [](int number) { return 2.304 * number; });

/// Velodyne's VLP-32C: the angles of its manual; ros-drivers/velodyne VeloView-VLP-32C.yaml.
constexpr Laser vlp_32c_lasers[] = {
    {15, 1.4, 29},      {10.333, -1.4, 30}, {7, 1.4, 25},      {4.667, -1.4, 26},
    {3.333, 1.4, 21},   {2.333, -1.4, 22},  {1.667, 4.2, 17},  {1.333, 1.4, 13},
    {1, -1.4, 18},      {0.667, -4.2, 14},  {0.333, 4.2, 9},   {0, 1.4, 5},
    {-0.333, -1.4, 10}, {-0.667, -4.2, 6},  {-1, 4.2, 1},      {-1.333, 1.4, 31},
    {-1.667, -1.4, 2},  {-2, -4.2, 28},     {-2.333, 4.2, 27}, {-2.667, 1.4, 23},
    {-3, -1.4, 24},     {-3.333, -4.2, 20}, {-3.667, 4.2, 19}, {-4, 1.4, 15},
    {-4.667, -1.4, 16}, {-5.333, -4.2, 12}, {-6.148, 1.4, 11}, {-7.254, -1.4, 8},
    {-8.843, 1.4, 7},   {-11.31, -1.4, 4},  {-15.639, 1.4, 3}, {-25, -1.4, 0}};

/// Two lasers at a time; user manual 63-9325, section 9.4.
constexpr auto vlp_32c = fired(vlp_32c_lasers, [](int number) { return 2.304 * (number / 2); });

/// Calibration of one HDL-64E: ros-drivers/velodyne 64e_utexas.yaml, to 0.01 degrees. Each sensor
/// has a calibration of its own.
constexpr Laser hdl_64e_lasers[] = {
    {2.02, 2, 29},      {1.68, 0.6, 28},    {1.34, -2, 25},      {1, -3.5, 24},
    {0.66, 6, 3},       {0.32, 4, 2},       {-0.02, 1.7, 31},    {-0.36, -0.25, 30},
    {-0.7, -2.7, 27},   {-1.04, -4.5, 26},  {-1.38, 6.25, 21},   {-1.72, 4.9, 20},
    {-2.06, 2.25, 17},  {-2.4, 0.5, 16},    {-2.74, -2, 13},     {-3.08, -3.9, 12},
    {-3.42, 6, 23},     {-3.76, 4, 22},     {-4.1, 1.75, 19},    {-4.44, 0, 18},
    {-4.78, -2.75, 15}, {-5.12, -4.8, 14},  {-5.46, 6.5, 9},     {-5.8, 4.7, 8},
    {-6.14, 2.25, 5},   {-6.48, 0.8, 4},    {-6.82, -2.25, 1},   {-7.16, -4, 0},
    {-7.5, 6, 11},      {-7.84, 4, 10},     {-8.18, 1.3, 7},     {-8.52, 0, 6},
    {-8.95, 2.5, 61},   {-9.46, 0, 60},     {-9.98, -3.5, 57},   {-10.49, -6, 56},
    {-11, 8.5, 35},     {-11.51, 5.5, 34},  {-12.03, 1.8, 63},   {-12.54, -1, 62},
    {-13.05, -4.5, 59}, {-13.56, -8, 58},   {-14.07, 9.5, 53},   {-14.58, 7, 52},
    {-15.09, 3.2, 49},  {-15.6, 0, 48},     {-16.11, -3.25, 45}, {-16.62, -6.5, 44},
    {-17.12, 9, 55},    {-17.63, 6, 54},    {-18.14, 2, 51},     {-18.56, -1, 50},
    {-19.16, -5, 47},   {-19.67, -8, 46},   {-20.18, 10, 41},    {-20.69, 7, 40},
    {-21.2, 3.5, 37},   {-21.71, -0.5, 36}, {-22.23, -3.5, 33},  {-22.74, -7, 32},
    {-23.25, 9.5, 43},  {-23.76, 6, 42},    {-24.28, 2, 39},     {-24.71, -1, 38}};

/// The lower and the upper block fire at the same time, each in groups of four lasers; user manual
/// 63-HDL64ES3, firing times of single returns, as VeloView counts them.
constexpr auto hdl_64e = fired(hdl_64e_lasers, [](int number) {
  constexpr double in_group[] = {0, 1.26, 2.46, 3.66};
  return 6.0 * (number % 32 / 4) + in_group[number % 4];
});

/// Calibration of one OS1-64 (OS-1-64-U02): ouster-sdk os1_64.json. Ouster counts azimuths
/// clockwise. Each sensor has a calibration of its own. All channels fire at once.
constexpr LidarChannel os1_64[] = {
    {21.02, -1.43}, {20.39, 4.2},    {19.76, -1.45},  {19.15, 4.2},    {18.5, -1.42},
    {17.86, 4.21},  {17.21, -1.42},  {16.58, 4.21},   {15.91, -1.42},  {15.27, 4.21},
    {14.6, -1.42},  {13.94, 4.2},    {13.26, -1.42},  {12.6, 4.21},    {11.9, -1.4},
    {11.24, 4.2},   {10.55, -1.42},  {9.87, 4.21},    {9.18, -1.42},   {8.48, 4.22},
    {7.77, -1.41},  {7.09, 4.22},    {6.38, -1.4},    {5.69, 4.22},    {4.99, -1.4},
    {4.3, 4.21},    {3.59, -1.42},   {2.9, 4.21},     {2.19, -1.42},   {1.48, 4.23},
    {0.77, -1.41},  {0.06, 4.24},    {-0.65, -1.4},   {-1.34, 4.23},   {-2.06, -1.4},
    {-2.76, 4.23},  {-3.46, -1.42},  {-4.17, 4.24},   {-4.85, -1.42},  {-5.57, 4.22},
    {-6.27, -1.4},  {-6.95, 4.22},   {-7.66, -1.4},   {-8.34, 4.22},   {-9.04, -1.4},
    {-9.73, 4.24},  {-10.42, -1.38}, {-11.09, 4.23},  {-11.76, -1.4},  {-12.45, 4.25},
    {-13.12, -1.4}, {-13.78, 4.23},  {-14.45, -1.39}, {-15.09, 4.22},  {-15.76, -1.4},
    {-16.41, 4.24}, {-17.06, -1.39}, {-17.69, 4.24},  {-18.32, -1.39}, {-18.95, 4.23},
    {-19.57, -1.4}, {-20.19, 4.22},  {-20.8, -1.4},   {-21.41, 4.22}};

/// Steps per turn at 10 turns per second, from the data sheets.
constexpr LidarModel models[] = {
    {"VLP-16", vlp_16, 1800}, {"VLP-32C", vlp_32c, 1800}, {"HDL-64E", hdl_64e, 2083},
    {"OS1-64", os1_64, 1024}, {"Mid-360", {}, 20000},
};

}  // namespace

std::span<const LidarModel> lidar_models() {
  return models;
}

const LidarModel* lidar_model(std::string_view name) {
  const auto found = std::ranges::find_if(
      models, [&](const LidarModel& model) { return letters_of(model.name) == letters_of(name); });
  return found == std::end(models) ? nullptr : &*found;
}

}  // namespace minkray
