// SPDX-License-Identifier: MIT
#include "renderer/generate/generate.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "core/support/named_kind.h"
#include "renderer/base/errors.h"
#include "renderer/generate/packing.h"
#include "renderer/generate/tumbling.h"
#include "renderer/io/output_file.h"
#include "renderer/json/json.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/scene_json/scene_json.h"

namespace minkray {
namespace {

/// Spheres, boxes and capsules that are put anywhere fill about this part of the cube.
constexpr double random_fill = 0.15;

/// Ellipsoids without overlap: dense enough that neighbours nearly touch, and far below where
/// random sequential addition finds no more room (about 0.38 for spheres).
constexpr double packed_fill = 0.17;

/// A row of numbers, as the file's floats.
using Row = std::vector<float>;

/// Contents of a kind of scene: poses of one shape, each with the numbers of its columns.
struct Posed {
  Json shape;
  std::vector<std::string> columns;
  double volume;  ///< of one shape, roughly
  double fill;
};

void append(Row& row, const Vec3<double>& v) {
  for (int axis = 0; axis < 3; ++axis) row.push_back(static_cast<float>(v[axis]));
}
void append(Row& row, const std::array<double, 4>& q) {
  for (const double entry : q) row.push_back(static_cast<float>(entry));
}

/// All shapes are about as large as a unit ball.
Posed posed(std::string_view kind) {
  const std::vector<std::string> turned = {"position", "rotation"};
  if (kind == "spheres")
    return {{{"type", "sphere"}, {"radius", 0.5}}, {"position"}, 0.5236, random_fill};
  if (kind == "rounded-boxes")
    return {{{"type", "rounded"},
             {"radius", 0.1},
             {"shape", {{"type", "box"}, {"half_extents", {0.5, 0.35, 0.2}}}}},
            turned,
            0.7,
            random_fill};
  if (kind == "ellipsoids")
    return {{{"type", "ellipsoid"}, {"radii", {0.75, 0.5, 0.35}}}, turned, 0.5498, packed_fill};
  if (kind == "capsules")
    return {{{"type", "capsule"}, {"radius", 0.1}, {"half_height", 1.5}}, turned, 0.0985, 0.05};
  throw WrongUsage("generate: unknown kind \"" + std::string(kind) + "\" (known are " +
                   listed(names_in(generated_kinds)) + ")");
}

/// A cube of that half size holds the shapes.
double half_size_for(const Posed& kind, std::size_t count) {
  return std::cbrt(static_cast<double>(count) * kind.volume / kind.fill) / 2;
}

/// Calls take(row) for each pose.
void for_each_pose(const GenerateOptions& options, const Posed& kind, double half_size,
                   const std::function<void(const Row&)>& take) {
  Random random(options.seed);
  Row row;
  if (options.kind == "ellipsoids") {
    for (const PackedPose& pose :
         pack_ellipsoids(options.count, {0.75, 0.5, 0.35}, half_size, random)) {
      row.clear();
      append(row, pose.position);
      append(row, pose.rotation);
      take(row);
    }
    return;
  }
  for (std::size_t i = 0; i < options.count; ++i) {
    row.clear();
    append(row, random.in_cube(half_size));
    if (kind.columns.size() > 1) append(row, random.rotation());
    take(row);
  }
}

/// A camera that sees the cube from above one of its edges, lights, and materials.
Json frame(const GenerateOptions& options, double half_size) {
  Json scene;
  scene["version"] = scene_version;
  scene["description"] = std::to_string(options.count) + " " + std::string(options.kind) +
                         " (minkray generate, seed " + std::to_string(options.seed) + ").";
  const double away = half_size + 1;
  scene["camera"] = {{"position", to_json(Vec3<double>(1.9, -3.3, 2.2) * away)},
                     {"look_at", to_json(Vec3<double>(0, 0, -0.1) * away)},
                     {"fov_y_degrees", 36},
                     {"resolution", {960, 720}}};
  scene["lights"] = Json::array(
      {{{"type", "directional"},
        {"direction", {-0.3, 1, -1.4}},
        {"color", {1, 0.96, 0.9}},
        {"intensity", 2.2}},
       {{"type", "environment"}, {"zenith", {0.55, 0.65, 0.8}}, {"nadir", {0.25, 0.23, 0.2}}}});
  scene["materials"] =
      Json::array({{{"name", "matt"}, {"type", "lambert"}, {"color", {0.75, 0.62, 0.45}}}});
  scene["objects"] = Json::array();
  scene["background"] = {0.93, 0.94, 0.96};
  return scene;
}

/// Each hull a cell of the grid: 8 to 40 points of a stretched sphere.
void generate_hulls(const GenerateOptions& options, const std::string& file) {
  if (options.count > most_generated_hulls)
    throw WrongUsage("generate: at most " + std::to_string(most_generated_hulls) + " hulls (got " +
                     std::to_string(options.count) + ")");
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(double(options.count))));
  const double half_size = 0.6 * static_cast<double>(side);
  Json scene = frame(options, half_size);
  Random random(options.seed);
  for (std::size_t i = 0; i < options.count; ++i) {
    const std::size_t x = i % side, y = i / side % side, z = i / side / side;
    const Vec3<double> cell(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
    const Vec3<double> radii(random.within(0.3, 0.5), random.within(0.3, 0.5),
                             random.within(0.3, 0.5));
    Json points = Json::array();
    for (std::uint64_t count = 8 + random.bits() % 33; count > 0; --count) {
      // Floats' values are short to write, and read as what they are.
      Json point = Json::array();
      const Vec3<double> p = radii.cwiseProduct(random.direction());
      for (int axis = 0; axis < 3; ++axis) point.push_back(std::round(p[axis] * 1e6) / 1e6);
      points.push_back(std::move(point));
    }
    Json place = Json::array();
    for (int axis = 0; axis < 3; ++axis) place.push_back(1.2 * (cell[axis] + 0.5) - half_size);
    scene["objects"].push_back({{"name", "hull " + std::to_string(i)},
                                {"shape", {{"type", "hull"}, {"points", std::move(points)}}},
                                {"material", "matt"},
                                {"transform", {{"translate", std::move(place)}}}});
  }
  write_file(file, scene.dump() + "\n");
}

void generate_tumbling(const GenerateOptions& options, const std::string& file) {
  if (options.count > most_tumbling)
    throw WrongUsage("generate: at most " + std::to_string(most_tumbling) +
                     " tumbling bodies (got " + std::to_string(options.count) + ")");
  write_file(file, tumbling_scene(options.count, options.seed).dump() + "\n");
}

}  // namespace

void generate_scene(const GenerateOptions& options, const std::string& file) {
  if (options.kind == "hulls") return generate_hulls(options, file);
  if (options.kind == "tumbling") return generate_tumbling(options, file);
  const Posed kind = posed(options.kind);
  const double half_size = half_size_for(kind, options.count);
  Json scene = frame(options, half_size);
  Json block = {{"name", options.kind},
                {"shape", kind.shape},
                {"material", "matt"},
                {"columns", kind.columns},
                {"count", options.count}};
  if (options.count <= most_inline_poses) {
    block["poses"] = Json::array();
    for_each_pose(options, kind, half_size, [&](const Row& row) {
      block["poses"].push_back(std::vector<double>(row.begin(), row.end()));
    });
  } else {
    const std::filesystem::path poses = std::filesystem::path(file).replace_extension(".f32");
    check_writable(file);
    OutputFile out(poses.string());
    for_each_pose(options, kind, half_size, [&](const Row& row) {
      out.write(std::span(reinterpret_cast<const unsigned char*>(row.data()),
                          row.size() * sizeof(float)));
    });
    out.finish();
    block["file"] = poses.filename().string();
  }
  scene["particles"] = Json::array({std::move(block)});
  write_file(file, scene.dump(1) + "\n");
}

}  // namespace minkray
