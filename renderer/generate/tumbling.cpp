// SPDX-License-Identifier: MIT
#include "renderer/generate/tumbling.h"

#include <cmath>

#include "renderer/generate/random.h"
#include "renderer/scene_json/scene_json.h"

namespace minkray {
namespace {

/// Interval between keys, in seconds: short enough for the fall to look like a parabola.
constexpr double key_step = 0.25;
constexpr int key_count = 9;

constexpr double gravity = 10;  ///< lengths a second squared
constexpr double spacing = 1.05;

/// Short to write, and finer than any picture shows.
double rounded(double value) {
  return std::round(value * 1e4) / 1e4;
}

template <class Numbers>
Json list_of(const Numbers& numbers) {
  Json list = Json::array();
  for (const double number : numbers) list.push_back(rounded(number));
  return list;
}

using Quaternion = std::array<double, 4>;

/// First b, then a.
Quaternion product(const Quaternion& a, const Quaternion& b) {
  const auto& [ax, ay, az, aw] = a;
  const auto& [bx, by, bz, bw] = b;
  return {aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
          aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz};
}

/// The turn from one key to the next: about any axis, up to about 75 degrees.
Quaternion turn(Random& random) {
  const Vec3<double> axis = random.direction() * random.within(0.1, 0.77);
  const double length = std::sqrt(axis.squaredNorm() + 1);
  return {axis.x() / length, axis.y() / length, axis.z() / length, 1 / length};
}

/// Each about as large as a ball of radius 0.5.
Json shape_of(std::size_t kind) {
  const Json box = {{"type", "box"}, {"half_extents", {0.35, 0.25, 0.15}}};
  switch (kind) {
    case 0:
      return {{"type", "rounded"}, {"radius", 0.08}, {"shape", box}};
    case 1:
      return {{"type", "capsule"}, {"radius", 0.16}, {"half_height", 0.3}};
    case 2:
      return {{"type", "cylinder"}, {"radius", 0.3}, {"half_height", 0.2}};
    case 3:
      return {{"type", "cone"}, {"radius", 0.35}, {"half_height", 0.35}};
    case 4:
      return {{"type", "ellipsoid"}, {"radii", {0.45, 0.3, 0.18}}};
    default:
      return {{"type", "minkowski_sum"},
              {"a", {{"type", "disk"}, {"radius", 0.3}}},
              {"b", {{"type", "ellipsoid"}, {"radii", {0.12, 0.12, 0.16}}}}};
  }
}

constexpr std::size_t shape_kinds = 6;

}  // namespace

Json tumbling_scene(std::size_t count, std::uint64_t seed) {
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count))));
  const double half_size = spacing * static_cast<double>(side) / 2;
  Json scene;
  scene["version"] = scene_version;
  scene["description"] = std::to_string(count) + " bodies that tumble (minkray generate, seed " +
                         std::to_string(seed) + ").";
  scene["camera"] = {{"position", list_of(Vec3<double>(2.0, -4.5, 1.0) * (half_size + 3))},
                     {"look_at", list_of(Vec3<double>(0, 0, -0.3) * (half_size + 3))},
                     {"fov_y_degrees", 40},
                     {"resolution", {960, 540}},
                     {"shutter", 0.02}};
  scene["lights"] = Json::array(
      {{{"type", "directional"},
        {"direction", {-0.5, 1, -1.3}},
        {"color", {1, 0.96, 0.9}},
        {"intensity", 2.2}},
       {{"type", "environment"}, {"zenith", {0.55, 0.65, 0.8}}, {"nadir", {0.3, 0.27, 0.22}}}});
  const double colours[shape_kinds][3] = {{0.85, 0.35, 0.2}, {0.2, 0.45, 0.7},  {0.9, 0.7, 0.25},
                                          {0.3, 0.6, 0.35},  {0.75, 0.75, 0.7}, {0.55, 0.3, 0.55}};
  scene["materials"] = Json::array();
  for (std::size_t kind = 0; kind < shape_kinds; ++kind) {
    const auto& [red, green, blue] = colours[kind];
    scene["materials"].push_back(
        {{"name", "m" + std::to_string(kind)}, {"type", "lambert"}, {"color", {red, green, blue}}});
  }
  scene["background"] = {{"zenith", {0.75, 0.83, 0.95}}, {"nadir", {0.95, 0.94, 0.92}}};

  Random random(seed);
  scene["objects"] = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t x = i % side, y = i / side % side, z = i / side / side;
    const Vec3<double> cell(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    const Vec3<double> from =
        spacing * (cell + Vec3<double>::Constant(0.5)) - Vec3<double>::Constant(half_size);
    // Outwards, and each a little its own way.
    const Vec3<double> velocity =
        0.45 * from + Vec3<double>(0, 0, 0.6 * half_size) + 2 * random.in_cube(1);
    Quaternion q = random.rotation();
    const Quaternion step = turn(random);
    const std::size_t kind = random.bits() % shape_kinds;
    Json keys = Json::array();
    for (int key = 0; key < key_count; ++key) {
      const double t = key * key_step;
      const Vec3<double> at = from + t * velocity - Vec3<double>(0, 0, gravity / 2 * t * t);
      keys.push_back({{"time", t}, {"translate", list_of(at)}, {"rotate", list_of(q)}});
      q = product(step, q);
    }
    scene["objects"].push_back({{"name", "body " + std::to_string(i)},
                                {"shape", shape_of(kind)},
                                {"material", "m" + std::to_string(kind)},
                                {"keys", std::move(keys)}});
  }
  return scene;
}

}  // namespace minkray
