// SPDX-License-Identifier: MIT
#include "renderer/sensor/lidar_models.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace minkray {
namespace {

/// Velodyne's VLP-16: the angles of its manual, 2 degrees apart; ros-drivers/velodyne VLP16db.yaml.
constexpr LidarChannel vlp_16[] = {{15.0, 0.0}, {13.0, 0.0},  {11.0, 0.0},  {9.0, 0.0},
                                   {7.0, 0.0},  {5.0, 0.0},   {3.0, 0.0},   {1.0, 0.0},
                                   {-1.0, 0.0}, {-3.0, 0.0},  {-5.0, 0.0},  {-7.0, 0.0},
                                   {-9.0, 0.0}, {-11.0, 0.0}, {-13.0, 0.0}, {-15.0, 0.0}};

/// Velodyne's VLP-32C: the angles of its manual; ros-drivers/velodyne VeloView-VLP-32C.yaml.
constexpr LidarChannel vlp_32c[] = {
    {15, 1.4},      {10.333, -1.4}, {7, 1.4},      {4.667, -1.4},  {3.333, 1.4},   {2.333, -1.4},
    {1.667, 4.2},   {1.333, 1.4},   {1, -1.4},     {0.667, -4.2},  {0.333, 4.2},   {0, 1.4},
    {-0.333, -1.4}, {-0.667, -4.2}, {-1, 4.2},     {-1.333, 1.4},  {-1.667, -1.4}, {-2, -4.2},
    {-2.333, 4.2},  {-2.667, 1.4},  {-3, -1.4},    {-3.333, -4.2}, {-3.667, 4.2},  {-4, 1.4},
    {-4.667, -1.4}, {-5.333, -4.2}, {-6.148, 1.4}, {-7.254, -1.4}, {-8.843, 1.4},  {-11.31, -1.4},
    {-15.639, 1.4}, {-25, -1.4}};

/// Calibration of one HDL-64E: ros-drivers/velodyne 64e_utexas.yaml, to 0.01 degrees. Each sensor
/// has a calibration of its own.
constexpr LidarChannel hdl_64e[] = {
    {2.02, 2},     {1.68, 0.6},    {1.34, -2},     {1, -3.5},      {0.66, 6},       {0.32, 4},
    {-0.02, 1.7},  {-0.36, -0.25}, {-0.7, -2.7},   {-1.04, -4.5},  {-1.38, 6.25},   {-1.72, 4.9},
    {-2.06, 2.25}, {-2.4, 0.5},    {-2.74, -2},    {-3.08, -3.9},  {-3.42, 6},      {-3.76, 4},
    {-4.1, 1.75},  {-4.44, 0},     {-4.78, -2.75}, {-5.12, -4.8},  {-5.46, 6.5},    {-5.8, 4.7},
    {-6.14, 2.25}, {-6.48, 0.8},   {-6.82, -2.25}, {-7.16, -4},    {-7.5, 6},       {-7.84, 4},
    {-8.18, 1.3},  {-8.52, 0},     {-8.95, 2.5},   {-9.46, 0},     {-9.98, -3.5},   {-10.49, -6},
    {-11, 8.5},    {-11.51, 5.5},  {-12.03, 1.8},  {-12.54, -1},   {-13.05, -4.5},  {-13.56, -8},
    {-14.07, 9.5}, {-14.58, 7},    {-15.09, 3.2},  {-15.6, 0},     {-16.11, -3.25}, {-16.62, -6.5},
    {-17.12, 9},   {-17.63, 6},    {-18.14, 2},    {-18.56, -1},   {-19.16, -5},    {-19.67, -8},
    {-20.18, 10},  {-20.69, 7},    {-21.2, 3.5},   {-21.71, -0.5}, {-22.23, -3.5},  {-22.74, -7},
    {-23.25, 9.5}, {-23.76, 6},    {-24.28, 2},    {-24.71, -1}};

/// Calibration of one OS1-64 (OS-1-64-U02): ouster-sdk os1_64.json. Ouster counts azimuths
/// clockwise. Each sensor has a calibration of its own.
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

/// Letters and digits of a name, in lower case.
std::string plain_name(std::string_view name) {
  std::string letters;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

}  // namespace

std::span<const LidarModel> lidar_models() {
  return models;
}

const LidarModel* lidar_model(std::string_view name) {
  const auto found = std::ranges::find_if(
      models, [&](const LidarModel& model) { return plain_name(model.name) == plain_name(name); });
  return found == std::end(models) ? nullptr : &*found;
}

}  // namespace minkray
