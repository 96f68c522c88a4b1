// SPDX-License-Identifier: MIT
#include "renderer/sensor/sensor_rays.h"

#include <cmath>
#include <numbers>

#include "renderer/base/errors.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/parse.h"
#include "renderer/json/values.h"
#include "renderer/sensor/npy.h"
#include "renderer/sensor/number_table.h"

namespace minkray {
namespace {

constexpr int most_side = 1 << 16;
constexpr std::size_t most_rays = std::size_t{1} << 28;  // some 60 GB, with their echoes

double radians(double degrees) {
  return degrees * (std::numbers::pi / 180);
}

/// Elevation from the horizon.
Vec3<double> direction_of(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/// Throws WrongUsage that begins with the option's name.
void check_count(double width, double height, const char* option) {
  if (width * height > double(most_rays))
    throw WrongUsage(std::string(option) + ": must be at most " + std::to_string(most_rays) +
                     " rays");
}

SensorRays spinning(const std::string& pattern, double seconds) {
  const std::string rest = pattern.substr(pattern.find(':') + 1);
  const std::size_t colon = rest.find(':');
  const auto counts = numbers_between(rest.substr(0, colon), 'x');
  double lowest = -15, highest = 15;
  bool is_good = counts && counts->size() == 2;
  if (colon != rest.npos) {
    const auto angles = numbers_between(rest.substr(colon + 1), ',');
    is_good = is_good && angles && angles->size() == 2 && (*angles)[0] <= (*angles)[1] &&
              (*angles)[0] >= -90 && (*angles)[1] <= 90;
    if (is_good) lowest = (*angles)[0], highest = (*angles)[1];
  }
  for (std::size_t i = 0; is_good && i < 2; ++i)
    is_good =
        (*counts)[i] >= 1 && (*counts)[i] <= most_side && (*counts)[i] == std::floor((*counts)[i]);
  if (!is_good)
    throw WrongUsage(
        "--pattern: must be spinning:CHANNELSxSTEPS, such as spinning:32x1800, with "
        ":LOWEST,HIGHEST "
        "elevations in degrees if wanted, or a CSV file (got " +
        printable(pattern, 80) + ")");
  check_count((*counts)[0], (*counts)[1], "--pattern");
  SensorRays rays;
  rays.height = static_cast<int>((*counts)[0]);
  rays.width = static_cast<int>((*counts)[1]);
  for (int channel = 0; channel < rays.height; ++channel) {
    const double share = rays.height > 1 ? double(channel) / (rays.height - 1) : 0.5;
    const double elevation = radians(highest + share * (lowest - highest));
    for (int step = 0; step < rays.width; ++step) {
      const double turn = double(step) / rays.width;
      // Clockwise from behind, so that the image's middle is ahead and its right is on the right.
      const double azimuth = std::numbers::pi - 2 * std::numbers::pi * (step + 0.5) / rays.width;
      rays.rays.push_back({{{0, 0, 0}, direction_of(azimuth, elevation)}, turn * seconds});
    }
  }
  return rays;
}

SensorRays rays_of_csv(const std::string& file) {
  Mistakes mistakes(file);
  const NumberTable table = read_number_table(file, mistakes);
  throw_if_any(mistakes);
  const auto time = table.column("time"), azimuth = table.column("azimuth"),
             zenith = table.column("zenith"), elevation = table.column("elevation");
  if (!azimuth || zenith.has_value() == elevation.has_value())
    mistakes.add(
        "line 1: must name the columns azimuth and zenith (or elevation), in degrees, and time, in "
        "seconds, if there is one");
  if (table.rows() == 0) mistakes.add("must have rays");
  throw_if_any(mistakes);
  SensorRays rays;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double up = zenith ? 90 - table.at(row, *zenith) : table.at(row, *elevation);
    rays.rays.push_back({{{0, 0, 0}, direction_of(radians(table.at(row, *azimuth)), radians(up))},
                         time ? table.at(row, *time) : 0});
  }
  return rays;
}

}  // namespace

SensorRays rays_of_npy(const std::string& file) {
  const NpyArray array = read_npy(file);
  if (array.shape.size() != 2 || (array.shape[1] != 6 && array.shape[1] != 7))
    throw BadInput(file +
                   ": must be an array of (N, 6) numbers, origins and directions, or (N, 7) with "
                   "t_max (got " +
                   array.shape_text() + ")");
  if (array.shape[0] > most_rays)
    throw BadInput(file + ": has more than " + std::to_string(most_rays) + " rays");
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

SensorRays rays_of_pattern(const std::string& pattern, double seconds) {
  return pattern == "spinning" || pattern.starts_with("spinning:") ? spinning(pattern, seconds)
                                                                   : rays_of_csv(pattern);
}

SensorRays rays_of_pinhole(const std::string& file) {
  Mistakes mistakes(file);
  const auto text = read_text_file(file, mistakes);
  const auto json = text ? parse_json(*text, mistakes) : std::nullopt;
  throw_if_any(mistakes);
  ObjectReader object(*json, JsonPath(), mistakes);
  const auto number = [&](const char* key, Range range) {
    const Json* written = object.require(key, "a number");
    return written ? read_number(*written, object.path(key), mistakes, range).value_or(1) : 1;
  };
  const auto pixels = [&](const char* key) {
    const Json* written = object.require(key, "a number of pixels");
    return written ? read_integer(*written, object.path(key), mistakes, 1, most_side).value_or(1)
                   : 1;
  };
  const double fx = number("fx", Range::positive), fy = number("fy", Range::positive);
  const double cx = number("cx", Range::any), cy = number("cy", Range::any);
  SensorRays rays;
  rays.width = pixels("width");
  rays.height = pixels("height");
  object.finish();
  throw_if_any(mistakes);
  check_count(rays.width, rays.height, "--pinhole");
  rays.rays.reserve(static_cast<std::size_t>(rays.width) * static_cast<std::size_t>(rays.height));
  for (int v = 0; v < rays.height; ++v)
    for (int u = 0; u < rays.width; ++u)
      rays.rays.push_back({{{0, 0, 0}, {(u - cx) / fx, (v - cy) / fy, 1}}, 0});
  return rays;
}

}  // namespace minkray
