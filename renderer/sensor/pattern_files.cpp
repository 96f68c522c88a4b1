// SPDX-License-Identifier: MIT
#include "renderer/sensor/pattern_files.h"

#include <bit>
#include <cstring>
#include <filesystem>

#include "core/files/regular_file.h"
#include "core/files/text.h"
#include "renderer/base/errors.h"
#include "renderer/base/of_file.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/parse.h"
#include "renderer/json/values.h"
#include "renderer/sensor/number_table.h"
#include "renderer/sensor/ray_directions.h"
#include "renderer/sensor/turning_rays.h"

namespace minkray {
namespace {

SensorRays rays_of_csv(const std::string& file, double) {
  Mistakes mistakes(file);
  const NumberTable table = read_number_table(file, mistakes);
  throw_if_any(mistakes);
  const auto time = table.column("time"), azimuth = table.column("azimuth"),
             zenith = table.column("zenith"), elevation = table.column("elevation");
  if (!azimuth || zenith.has_value() == elevation.has_value())
    mistakes.add(
        "line 1: must name the columns azimuth and zenith (or elevation) in degrees, and "
        "optionally time in seconds");
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

/// Limits of the numbers of a list, and the name of their kind and unit.
struct NumberLimits {
  int least, most;
  const char* kind;
  const char* unit;
};
constexpr NumberLimits elevation_limits{-90, 90, "angles", "degrees"},
    azimuth_limits{-360, 360, "angles", "degrees"}, delay_limits{0, 1, "times", "seconds"};

/// Reads a list of at least one number, each within the limits.
std::vector<double> read_list(const Json& json, const JsonPath& path, Mistakes& mistakes,
                              const NumberLimits& limits) {
  std::vector<double> numbers;
  if (!json.is_array() || json.empty()) {
    mistakes.add(path, std::string("must be a list of ") + limits.kind + " in " + limits.unit +
                           " (" + found(json) + ")");
    return numbers;
  }
  for (std::size_t i = 0; i < json.size(); ++i) {
    const auto number = read_number(json[i], path / i, mistakes);
    if (number && !(*number >= limits.least && *number <= limits.most))
      mistakes.add(path / i, "must be from " + std::to_string(limits.least) + " to " +
                                 std::to_string(limits.most) + " " + limits.unit + " (" +
                                 found(json[i]) + ")");
    numbers.push_back(number.value_or(0));
  }
  return numbers;
}

/// Returns a key of Ouster's metadata, which is at the top of old files and in a part of new ones.
const Json* of_ouster(const Json& json, std::string_view part, std::string_view key) {
  if (const Json* value = json.find(key)) return value;
  const Json* inner = json.find(part);
  return inner ? inner->find(key) : nullptr;
}

/// Steps per turn, at the beginning of Ouster's "lidar_mode": 1024 in "1024x10".
int ouster_steps(const Json& json, Mistakes& mistakes) {
  const Json* mode = of_ouster(json, "config_params", "lidar_mode");
  const std::string text = mode && mode->is_string() ? mode->text() : "";
  const auto numbers = numbers_between(text, 'x', bare_number);
  if (numbers && numbers->size() == 2 && (*numbers)[0] >= 1 && (*numbers)[0] <= most_turn_steps)
    return static_cast<int>((*numbers)[0]);
  mistakes.add(JsonPath() / "lidar_mode",
               "must be steps and turns per second, such as \"1024x10\"" +
                   (mode ? " (" + found(*mode) + ")" : std::string()));
  return 1;
}

SensorRays rays_of_json(const std::string& file, double seconds) {
  Mistakes mistakes(file);
  const auto text = read_text_file(file, mistakes);
  const auto json = text ? parse_json(*text, mistakes) : std::nullopt;
  throw_if_any(mistakes);
  std::vector<double> elevations, azimuths, delays;
  int steps = 1;
  const JsonPath root;
  if (const Json* up = of_ouster(*json, "beam_intrinsics", "beam_altitude_angles")) {
    elevations = read_list(*up, root / "beam_altitude_angles", mistakes, elevation_limits);
    if (const Json* side = of_ouster(*json, "beam_intrinsics", "beam_azimuth_angles"))
      for (const double angle :
           read_list(*side, root / "beam_azimuth_angles", mistakes, azimuth_limits))
        azimuths.push_back(-angle);
    steps = ouster_steps(*json, mistakes);
  } else {
    ObjectReader object(*json, root, mistakes);
    if (const Json* written = object.require("elevations", "a list of angles in degrees"))
      elevations = read_list(*written, object.path("elevations"), mistakes, elevation_limits);
    if (const Json* written = object.find("azimuths"))
      azimuths = read_list(*written, object.path("azimuths"), mistakes, azimuth_limits);
    if (const Json* written = object.find("firing_times"))
      delays = read_list(*written, object.path("firing_times"), mistakes, delay_limits);
    if (const Json* written = object.require("steps", "the number of steps of a turn"))
      steps =
          read_integer(*written, object.path("steps"), mistakes, 1, most_turn_steps).value_or(1);
    object.finish();
  }
  throw_if_any(mistakes);
  const auto match = [&](std::vector<double>& numbers, const char* name) {
    if (numbers.empty()) numbers.resize(elevations.size());
    if (numbers.size() != elevations.size())
      mistakes.add(std::string("must have as many ") + name + " as elevations (got " +
                   std::to_string(numbers.size()) + " and " + std::to_string(elevations.size()) +
                   ")");
  };
  match(azimuths, "azimuths");
  match(delays, "firing_times");
  if (double(elevations.size()) * steps > double(most_sensor_rays))
    mistakes.add("must be at most " + std::to_string(most_sensor_rays) + " rays");
  throw_if_any(mistakes);
  std::vector<LidarChannel> channels;
  for (std::size_t i = 0; i < elevations.size(); ++i)
    channels.push_back({elevations[i], azimuths[i], delays[i]});
  return turning_rays(channels, steps, seconds);
}

SensorRays rays_of_poses(const std::string& file, double) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::size_t pose_bytes = 12 * sizeof(float);
  const std::string bytes =
      of_file(file, [&] { return read_regular_file(file, most_sensor_rays * pose_bytes); });
  if (bytes.empty() || bytes.size() % pose_bytes != 0)
    throw BadInput(file + ": must be poses of 48 bytes, 12 floats each (got " +
                   std::to_string(bytes.size()) + " bytes)");
  SensorRays rays;
  for (std::size_t at = 0; at < bytes.size(); at += pose_bytes) {
    float m[12];
    std::memcpy(m, bytes.data() + at, sizeof m);
    const Vec3<double> origin(m[3], m[7], m[11]), direction(m[2], m[6], m[10]);
    if (!origin.allFinite() || !direction.allFinite() || direction.isZero(0))
      throw BadInput(file + ": pose " + std::to_string(at / pose_bytes) +
                     " must be finite, with a z axis that is not zero");
    rays.rays.push_back({{origin, unit<double>(direction)}, 0});
  }
  return rays;
}

constexpr PatternFormat kinds_of_patterns[] = {
    {".csv", rays_of_csv}, {".json", rays_of_json}, {".mat3x4f", rays_of_poses}};

}  // namespace

std::span<const PatternFormat> pattern_formats() {
  return kinds_of_patterns;
}

const PatternFormat* pattern_format_of(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  for (const PatternFormat& format : kinds_of_patterns)
    if (format.ending == ending) return &format;
  return nullptr;
}

}  // namespace minkray
