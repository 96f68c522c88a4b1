// SPDX-License-Identifier: MIT
#include "renderer/sensor/sensor_path.h"

#include <cmath>

#include "renderer/sensor/number_table.h"

namespace minkray {

MovingFrame read_sensor_path(const std::string& file) {
  Mistakes mistakes(file);
  const NumberTable table = read_number_table(file, mistakes);
  throw_if_any(mistakes);
  constexpr const char* titles[] = {"time", "x", "y", "z", "qx", "qy", "qz", "qw"};
  std::optional<std::size_t> columns[8];
  for (std::size_t i = 0; i < 8; ++i) columns[i] = table.column(titles[i]);
  const bool turns = columns[4] || columns[5] || columns[6] || columns[7];
  for (std::size_t i = 0; i < (turns ? 8u : 4u); ++i)
    if (!columns[i]) mistakes.add(std::string("line 1: must name the column ") + titles[i]);
  if (table.rows() == 0) mistakes.add("must have poses");
  throw_if_any(mistakes);
  MovingFrame path;
  path.motion = Motion{};
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto number = [&](std::size_t i) { return table.at(row, *columns[i]); };
    PoseKey key;
    key.time = number(0);
    key.translate = {number(1), number(2), number(3)};
    if (turns) {
      const double size = std::max(
          {std::abs(number(4)), std::abs(number(5)), std::abs(number(6)), std::abs(number(7))});
      if (size == 0) {
        mistakes.add("pose " + std::to_string(row) + ": the quaternion must not be zero");
        continue;
      }
      double square = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        key.rotate[i] = number(4 + i) / size;
        square += key.rotate[i] * key.rotate[i];
      }
      for (double& entry : key.rotate) entry /= std::sqrt(square);
    }
    if (!path.motion->keys.empty() && !(key.time > path.motion->keys.back().time))
      mistakes.add("pose " + std::to_string(row) + ": times must increase");
    path.motion->keys.push_back(key);
    if (mistakes.messages().size() >= 20) break;
  }
  throw_if_any(mistakes);
  return path;
}

}  // namespace minkray
