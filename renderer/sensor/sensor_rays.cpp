// SPDX-License-Identifier: MIT
#include "renderer/sensor/sensor_rays.h"

#include <atomic>
#include <cmath>
#include <limits>

#include "core/parallel/parallel.h"
#include "renderer/base/errors.h"
#include "renderer/sensor/npy.h"

namespace minkray {
SensorRays rays_of_npy(const std::string& file) {
  const NpyArray array = read_npy(file);
  if (array.shape.size() != 2 || (array.shape[1] != 6 && array.shape[1] != 7))
    throw BadInput(file +
                   ": must be an array of (N, 6) numbers, origins and directions, or (N, 7) with "
                   "t_max (got " +
                   array.shape_text() + ")");
  if (array.shape[0] > most_sensor_rays)
    throw BadInput(file + ": has more than " + std::to_string(most_sensor_rays) + " rays");
  SensorRays rays;
  const std::size_t width = array.shape[1];
  rays.rays.resize(array.shape[0]);
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const double* row = array.values.data() + i * width;
    Ray<double>& ray = rays.rays[i].ray;
    ray.origin = {row[0], row[1], row[2]};
    ray.direction = {row[3], row[4], row[5]};
    if (width == 7) ray.t_max = row[6];
    if (!ray.origin.allFinite() || !ray.direction.allFinite() || std::isnan(ray.t_max))
      throw BadInput(file + ": ray " + std::to_string(i) + " must be finite numbers");
  }
  return rays;
}

SensorRays rays_of_camera(const CalibratedCamera& camera, const std::string& name) {
  const CalibratedCamera::Numbers& numbers = camera.numbers();
  const auto width = static_cast<std::size_t>(numbers.width);
  const std::size_t pixels = width * static_cast<std::size_t>(numbers.height);
  if (pixels > most_sensor_rays)
    throw WrongUsage("--pinhole: must be at most " + std::to_string(most_sensor_rays) + " rays");
  SensorRays rays;
  rays.width = numbers.width;
  rays.height = numbers.height;
  rays.rays.resize(pixels);
  std::atomic<std::size_t> missing = 0;
  parallel_for(static_cast<std::size_t>(numbers.height), 16,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t v = begin; v < end; ++v)
                   for (std::size_t u = 0; u < width; ++u) {
                     const auto direction = camera.direction(double(u), double(v));
                     if (!direction) ++missing;
                     rays.rays[v * width + u] = {{{0, 0, 0},
                                                  direction.value_or(Vec3<double>::Constant(
                                                      std::numeric_limits<double>::quiet_NaN()))},
                                                 double(v) * numbers.row_time};
                   }
               });
  rays.missing = missing;
  if (rays.missing == pixels)
    throw BadInput(name + ": must have pixels where its distortion has an inverse (got none)");
  return rays;
}

SensorRays rays_of_pinhole(const std::string& file) {
  return rays_of_camera(read_calibrated_camera(file), file);
}

}  // namespace minkray
