// SPDX-License-Identifier: MIT
#include "renderer/json/values.h"
#include "renderer/json/limits.h"

#include <cmath>

namespace minkray {
namespace {

std::string must_be(std::string_view expected, const Json& json) {
  return "must be " + std::string(expected) + " (" + found(json) + ")";
}

/// "a number" or "a number > 0".
std::string a_number(Range range) {
  std::string text = "a number";
  if (!constraint(range).empty()) text += " " + std::string(constraint(range));
  return text;
}

}  // namespace

std::string found(const Json& json) {
  switch (json.kind()) {
    case Json::Kind::object:
      return "got an object";
    case Json::Kind::list:
      return "got a list of " + std::to_string(json.size());
    case Json::Kind::string:
      return "got \"" + printable(json.text(), 60) + "\"";
    default:
      return "got " + json.dump();
  }
}

std::string_view constraint(Range range) {
  return limits_of(range).text;
}

bool in_range(double value, Range range) {
  return limits_of(range).allow(value);
}

std::optional<double> read_number(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                  Range range) {
  if (!json.is_number()) {
    mistakes.add(path, must_be(a_number(range), json));
    return std::nullopt;
  }
  const double value = json.get<double>();
  if (!std::isfinite(value)) {
    mistakes.add(path, must_be("a finite number", json));
    return std::nullopt;
  }
  if (!in_range(value, range)) {
    mistakes.add(path, must_be(constraint(range), json));
    return std::nullopt;
  }
  return value;
}

std::optional<int> read_integer(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                int lowest, int highest) {
  // Checks the value, not its spelling: 1.0 is a whole number, too.
  if (json.is_number()) {
    const double value = json.get<double>();
    if (value >= lowest && value <= highest && value == std::floor(value)) {
      return static_cast<int>(value);
    }
  }
  const std::string range = lowest == highest ? std::to_string(lowest)
                                              : "a whole number from " + std::to_string(lowest) +
                                                    " to " + std::to_string(highest);
  mistakes.add(path, must_be(range, json));
  return std::nullopt;
}

std::optional<std::string> read_string(const Json& json, const JsonPath& path, Mistakes& mistakes) {
  if (json.is_string()) return json.get<std::string>();
  mistakes.add(path, must_be("a text in double quotes", json));
  return std::nullopt;
}

std::optional<bool> read_bool(const Json& json, const JsonPath& path, Mistakes& mistakes) {
  if (json.is_boolean()) return json.get<bool>();
  mistakes.add(path, must_be("true or false", json));
  return std::nullopt;
}

std::optional<std::vector<double>> read_numbers(const Json& json, const JsonPath& path,
                                                Mistakes& mistakes, std::size_t count,
                                                Range range) {
  if (!json.is_array() || json.size() != count) {
    mistakes.add(path, must_be("a list of " + std::to_string(count) + " numbers", json));
    return std::nullopt;
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    if (const auto number = read_number(json[i], path / i, mistakes, range)) {
      numbers.push_back(*number);
    }
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

std::optional<Vec3<double>> read_vector(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                        Range range) {
  const auto numbers = read_numbers(json, path, mistakes, 3, range);
  if (!numbers) return std::nullopt;
  return Vec3<double>((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

std::optional<std::vector<Vec3<double>>> read_points(const Json& json, const JsonPath& path,
                                                     Mistakes& mistakes, std::size_t least,
                                                     std::size_t most) {
  if (!json.is_array() || json.size() < least || json.size() > most) {
    const std::string count = least == most ? std::to_string(least) + " points"
                                            : "points, at least " + std::to_string(least);
    mistakes.add(path, must_be("a list of " + count + ", each of 3 numbers", json));
    return std::nullopt;
  }
  std::vector<Vec3<double>> points;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (const auto point = read_vector(json[i], path / i, mistakes)) points.push_back(*point);
  }
  if (points.size() != json.size()) return std::nullopt;
  return points;
}

}  // namespace minkray
