// SPDX-License-Identifier: MIT
#include "renderer/member_json/read_rotation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"
#include "renderer/member_json/member_codec.h"

namespace minkray {
namespace {

using Quaternion = std::array<double, 4>;

/// A direction is taken for upright if the sine of its angle to z is below this.
constexpr double upright_sine = 1e-9;

constexpr const char* spellings =
    "a quaternion [x, y, z, w] or one of {\"axis\": [x, y, z], \"degrees\": d}, "
    "{\"euler_xyz_degrees\": [x, y, z]} and {\"look_at\": [x, y, z]}";

Quaternion about(const Vec3<double>& unit_axis, double degrees) {
  const double half = std::remainder(degrees, 720.0) * std::numbers::pi / 360;
  const Vec3<double> xyz = std::sin(half) * unit_axis;
  return {xyz.x(), xyz.y(), xyz.z(), std::cos(half)};
}

/// First b, then a.
Quaternion times(const Quaternion& a, const Quaternion& b) {
  const Vec3<double> u(a[0], a[1], a[2]), v(b[0], b[1], b[2]);
  const Vec3<double> xyz = a[3] * v + b[3] * u + u.cross(v);
  return {xyz.x(), xyz.y(), xyz.z(), a[3] * b[3] - u.dot(v)};
}

Quaternion about_axes(const Vec3<double>& degrees) {
  return times(about({0, 0, 1}, degrees.z()),
               times(about({0, 1, 0}, degrees.y()), about({1, 0, 0}, degrees.x())));
}

/// The quaternion of a rotation matrix, by its largest entry (Shepperd 1978).
Quaternion of_matrix(const Mat3<double>& m) {
  const double t[4] = {1 + m(0, 0) - m(1, 1) - m(2, 2), 1 - m(0, 0) + m(1, 1) - m(2, 2),
                       1 - m(0, 0) - m(1, 1) + m(2, 2), 1 + m(0, 0) + m(1, 1) + m(2, 2)};
  const auto largest = std::max_element(t, t + 4) - t;
  Quaternion q;
  if (largest == 0)
    q = {t[0], m(0, 1) + m(1, 0), m(0, 2) + m(2, 0), m(2, 1) - m(1, 2)};
  else if (largest == 1)
    q = {m(0, 1) + m(1, 0), t[1], m(1, 2) + m(2, 1), m(0, 2) - m(2, 0)};
  else if (largest == 2)
    q = {m(0, 2) + m(2, 0), m(1, 2) + m(2, 1), t[2], m(1, 0) - m(0, 1)};
  else
    q = {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1), t[3]};
  return unit_quaternion(q);
}

/// Turns z to a direction and keeps x level: straight up nothing turns, straight down it turns half
/// about x.
Quaternion z_towards(const Vec3<double>& direction) {
  const Vec3<double> z = unit(direction), up(0, 0, 1);
  const Vec3<double> level = up.cross(z);
  if (!(level.norm() > upright_sine))
    return z.z() > 0 ? Quaternion{0, 0, 0, 1} : Quaternion{1, 0, 0, 0};
  Mat3<double> turn;
  turn.col(0) = unit(level);
  turn.col(2) = z;
  turn.col(1) = z.cross(turn.col(0));
  return of_matrix(turn);
}

std::optional<Quaternion> read_quaternion(const Json& json, const JsonPath& path,
                                          Mistakes& mistakes) {
  const auto q = read_numbers(json, path, mistakes, 4);
  if (!q) return std::nullopt;
  double largest = 0;
  for (const double entry : *q) largest = std::max(largest, std::abs(entry));
  if (!(largest > 0)) {
    mistakes.add(path, "must be a quaternion [x, y, z, w] other than zero (" + found(json) + ")");
    return std::nullopt;
  }
  return Quaternion{(*q)[0], (*q)[1], (*q)[2], (*q)[3]};
}

std::optional<Quaternion> read_axis(ObjectReader& object) {
  Mistakes& mistakes = object.mistakes();
  const Json* const written_axis = object.require("axis", "the axis to turn about: 3 numbers");
  const Json* const written_degrees = object.require("degrees", "the angle to turn by, a number");
  if (!object.finish() || !written_axis || !written_degrees) return std::nullopt;
  const auto axis = read_vector(*written_axis, object.path("axis"), mistakes);
  const auto degrees = read_number(*written_degrees, object.path("degrees"), mistakes);
  if (!axis || !degrees) return std::nullopt;
  if (axis->isZero(0)) {
    mistakes.add(object.path("axis"), "must not be zero");
    return std::nullopt;
  }
  return about(unit(*axis), *degrees);
}

}  // namespace

std::array<double, 4> unit_quaternion(std::array<double, 4> q) {
  // Divides by the largest entry first, so that squares stay in range.
  double largest = 0, squares = 0;
  for (const double entry : q) largest = std::max(largest, std::abs(entry));
  for (double& entry : q) {
    entry /= largest;
    squares += entry * entry;
  }
  for (double& entry : q) entry /= std::sqrt(squares);
  return q;
}

std::optional<std::array<double, 4>> read_rotation(const Json& json, const JsonPath& path,
                                                   Mistakes& mistakes, const Vec3<double>& place) {
  if (json.is_array() && json.size() == 4) return read_quaternion(json, path, mistakes);
  if (!json.is_object()) {
    const char* hint =
        json.is_array() && json.size() == 3 ? "; three angles are euler_xyz_degrees" : "";
    mistakes.add(path, std::string("must be ") + spellings + " (" + found(json) + hint + ")");
    return std::nullopt;
  }
  ObjectReader object(json, path, mistakes);
  if (json.contains("axis") || json.contains("degrees")) return read_axis(object);
  if (const Json* angles = object.find("euler_xyz_degrees")) {
    const auto degrees = read_vector(*angles, object.path("euler_xyz_degrees"), mistakes);
    if (!object.finish() || !degrees) return std::nullopt;
    return about_axes(*degrees);
  }
  if (const Json* target = object.find("look_at")) {
    const auto point = read_vector(*target, object.path("look_at"), mistakes);
    if (!object.finish() || !point) return std::nullopt;
    const Vec3<double> direction = *point - place;
    if (unit(direction).isZero(0)) {
      mistakes.add(object.path("look_at"), "must not be the object's own position (" +
                                               printable(target->dump(), 100) + ")");
      return std::nullopt;
    }
    return z_towards(direction);
  }
  mistakes.add(path, std::string("must be ") + spellings + " (" + found(json) + " with " +
                         (json.empty() ? "nothing in it"
                                       : "\"" + printable(json.members()[0].key, 60) + "\"") +
                         ")");
  return std::nullopt;
}

Json rotation_schema() {
  const auto keys = [](std::initializer_list<const char*> names, Json properties) {
    Json required = Json::array();
    for (const char* name : names) required.push_back(name);
    Json schema = {{"type", "object"}, {"additionalProperties", false}};
    schema["properties"] = std::move(properties);
    schema["required"] = std::move(required);
    return schema;
  };
  const Json number = schema_of_number(Range::any), three = schema_of_list(number, 3);
  return {{"oneOf", Json::array({schema_of_list(number, 4),
                                 keys({"axis", "degrees"}, {{"axis", three}, {"degrees", number}}),
                                 keys({"euler_xyz_degrees"}, {{"euler_xyz_degrees", three}}),
                                 keys({"look_at"}, {{"look_at", three}})})}};
}

}  // namespace minkray
