// SPDX-License-Identifier: MIT
#include "renderer/scene/mesh_json.h"

#include <cmath>
#include <stdexcept>

#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"
#include "renderer/scene/write_member.h"

namespace minkray {
namespace {

constexpr std::size_t most_items = std::size_t{1} << 30;

std::optional<std::vector<Corners>> read_corners(const Json& json, const JsonPath& path,
                                                 Mistakes& mistakes) {
  if (!json.is_array() || json.empty()) {
    mistakes.add(path, "must be a list of triangles, at least one (" + found(json) + ")");
    return std::nullopt;
  }
  std::vector<Corners> triangles;
  triangles.reserve(json.size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    const Json& written = json[i];
    Corners corners = {};
    bool is_good = written.is_array() && written.size() == 3;
    for (std::size_t k = 0; k < 3 && is_good; ++k) {
      is_good = written[k].is_number_unsigned() && written[k].get<std::uint64_t>() < most_items;
      if (is_good) corners[k] = static_cast<std::uint32_t>(written[k].get<std::uint64_t>());
    }
    if (!is_good) {
      mistakes.add(path / i,
                   "must be a list of three numbers of vertices (" + found(written) + ")");
      return std::nullopt;
    }
    triangles.push_back(corners);
  }
  return triangles;
}

/// Rounding of normals.
constexpr double same_way = 1e-9;

bool looks_one_way(const TriangleMesh& mesh) {
  const Vec3<double> first = mesh.normal(0);
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    const double height = first.dot(mesh.corner(i, 0) - mesh.corner(0, 0));
    if ((mesh.normal(i) - first).norm() > same_way || std::abs(height) > same_way * mesh.reach())
      return false;
  }
  return !first.isZero(0);
}

}  // namespace

std::shared_ptr<const TriangleMesh> read_mesh(const Json& json, const JsonPath& path,
                                              Mistakes& mistakes, MeshFiles& files) {
  ObjectReader object(json, path, mistakes);
  if (!object.is_object()) return nullptr;
  if (const Json* const file = object.find("file")) {
    const auto name = read_string(*file, object.path("file"), mistakes);
    const Json* const written = object.find("scale");
    const auto scale =
        written ? read_number(*written, object.path("scale"), mistakes, Range::positive) : 1.0;
    if (!object.finish() || !name || !scale) return nullptr;
    return files.read_mesh(*name, *scale, object.path("file"), mistakes);
  }
  const Json* const points = object.require("vertices", "a list of points, or \"file\"");
  const Json* const numbers =
      object.require("triangles", "a list of three numbers of vertices each");
  std::optional<std::vector<Vec3<double>>> vertices;
  std::optional<std::vector<Corners>> triangles;
  if (points) vertices = read_points(*points, object.path("vertices"), mistakes, 3, most_items);
  if (numbers) triangles = read_corners(*numbers, object.path("triangles"), mistakes);
  MeshSides sides = MeshSides::both;
  if (const Json* const written = object.find("sides")) {
    const auto name = read_string(*written, object.path("sides"), mistakes);
    if (!name) return nullptr;
    if (*name == "front")
      sides = MeshSides::front;
    else if (*name != "both")
      mistakes.add(object.path("sides"), "must be \"both\" or \"front\" (" + found(*written) + ")");
  }
  if (!object.finish() || !vertices || !triangles) return nullptr;
  try {
    auto mesh =
        std::make_shared<const TriangleMesh>(std::move(*vertices), std::move(*triangles), sides);
    if (sides == MeshSides::front && !looks_one_way(*mesh)) {
      mistakes.add(object.path("sides"),
                   "must be \"both\" unless all triangles lie in one plane and look the same way");
      return nullptr;
    }
    return mesh;
  } catch (const std::invalid_argument& error) {
    mistakes.add(path, error.what());
    return nullptr;
  }
}

Json write_mesh(const TriangleMesh& mesh) {
  Json json = {{"vertices", Json::array()}, {"triangles", Json::array()}};
  if (mesh.sides() == MeshSides::front) json["sides"] = "front";
  for (const Vec3<double>& vertex : mesh.vertices()) json["vertices"].push_back(to_json(vertex));
  for (const Corners& t : mesh.triangles())
    json["triangles"].push_back(Json::array({t[0], t[1], t[2]}));
  return json;
}

}  // namespace minkray
