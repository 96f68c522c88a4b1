// SPDX-License-Identifier: MIT
// rays_of_pattern: parses the text of a pattern.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/support/named_kind.h"
#include "renderer/base/errors.h"
#include "renderer/json/object_reader.h"
#include "renderer/sensor/pattern_files.h"
#include "renderer/sensor/turning_rays.h"

namespace minkray {
namespace {

bool is_count(double number, double most) {
  return number >= 1 && number <= most && number == std::floor(number);
}

/// Reads two angles, each from -most to most; returns nothing for anything else.
std::optional<std::pair<double, double>> two_angles(std::string_view text, double most) {
  const auto angles = numbers_between(text, ',', bare_number);
  if (!angles || angles->size() != 2) return std::nullopt;
  for (const double angle : *angles)
    if (!(std::abs(angle) <= most)) return std::nullopt;
  return std::pair((*angles)[0], (*angles)[1]);
}

void check_rays(double rays) {
  if (rays > double(most_sensor_rays))
    throw WrongUsage("--pattern: must be at most " + std::to_string(most_sensor_rays) + " rays");
}

SensorRays spinning(const std::string& pattern, double seconds) {
  const std::vector<std::string> parts = pieces_of(pattern, ':');
  const auto counts = parts.size() > 1 ? numbers_between(parts[1], 'x', bare_number) : std::nullopt;
  std::pair<double, double> elevations(-15, 15);
  std::optional<AzimuthRange> range;
  bool is_good = parts.size() <= 4 && counts && counts->size() == 2 &&
                 is_count((*counts)[0], most_turn_steps) && is_count((*counts)[1], most_turn_steps);
  if (is_good && parts.size() > 2) {
    const auto angles = two_angles(parts[2], 90);
    is_good = angles && angles->first <= angles->second;
    elevations = angles.value_or(elevations);
  }
  if (is_good && parts.size() > 3) {
    const auto angles = two_angles(parts[3], 360);
    is_good = angles && std::abs(angles->second - angles->first) <= 360;
    if (is_good) range = AzimuthRange{angles->first, angles->second};
  }
  if (!is_good)
    throw WrongUsage(
        "--pattern: must be spinning:CHANNELSxSTEPS[:LOWEST,HIGHEST[:FROM,TO]] (degrees), such as "
        "spinning:32x1800 (got " +
        printable(pattern, 80) + ")");
  const int height = static_cast<int>((*counts)[0]), width = static_cast<int>((*counts)[1]);
  check_rays(double(height) * width);
  const auto [lowest, highest] = elevations;
  std::vector<LidarChannel> channels;
  for (int channel = 0; channel < height; ++channel) {
    const double share = height > 1 ? double(channel) / (height - 1) : 0.5;
    channels.push_back({highest + share * (lowest - highest), 0});
  }
  return turning_rays(channels, width, seconds, range ? &*range : nullptr);
}

SensorRays of_model(const LidarModel& model, const std::vector<std::string>& parts, double seconds,
                    double start) {
  const bool spins = !model.channels.empty();
  const double most = spins ? most_turn_steps : double(most_sensor_rays);
  double count = model.steps;
  if (!spins) count = std::max(1.0, std::round(2 * model.steps * 5 * seconds));
  if (parts.size() > 1) {
    const auto numbers = numbers_between(parts[1], ',', bare_number);
    if (parts.size() > 2 || !numbers || numbers->size() != 1 || !is_count((*numbers)[0], most))
      throw WrongUsage("--pattern: must be " + std::string(model.name) + " or " +
                       std::string(model.name) + (spins ? ":STEPS of a turn" : ":RAYS") +
                       " (got :" + printable(parts[1], 80) + ")");
    count = (*numbers)[0];
  }
  check_rays(spins ? count * double(model.channels.size()) : count);
  if (!spins) return mid_360_rays(static_cast<std::size_t>(count), start);
  return turning_rays(model.channels, static_cast<int>(count), seconds);
}

}  // namespace

SensorRays rays_of_pattern(const std::string& pattern, double seconds, double start) {
  const std::vector<std::string> parts = pieces_of(pattern, ':');
  if (parts[0] == "spinning") return spinning(pattern, seconds);
  if (const PatternFormat* format = pattern_format_of(pattern))
    return format->read(pattern, seconds);
  if (const LidarModel* model = lidar_model(parts[0]))
    return of_model(*model, parts, seconds, start);
  if (std::filesystem::exists(pattern)) return pattern_formats()[0].read(pattern, seconds);
  std::vector<std::string> names = names_in(lidar_models());
  names.insert(names.begin(), "spinning:CHANNELSxSTEPS");
  const std::string endings = listed(pattern_formats(), &PatternFormat::ending);
  throw WrongUsage("--pattern: must be a lidar's name or a file (" + endings + ") (got \"" +
                   printable(pattern, 80) + "\"; " + suggestion(parts[0], names) + ")");
}

}  // namespace minkray
