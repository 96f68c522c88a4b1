// SPDX-License-Identifier: MIT
#include "renderer/scene_json/mesh_json.h"

#include <cmath>
#include <stdexcept>

#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/scene_json/mesh_attributes_json.h"

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
    if (!written.is_array() || written.size() != 3) {
      mistakes.add(path / i,
                   "must be a list of three numbers of vertices (" + found(written) + ")");
      return std::nullopt;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (!written[k].is_number_unsigned() || written[k].get<std::uint64_t>() >= most_items) {
        mistakes.add(path / i / k, "must be the number of a vertex, a whole number from 0 on (" +
                                       found(written[k]) + ")");
        return std::nullopt;
      }
      corners[k] = static_cast<std::uint32_t>(written[k].get<std::uint64_t>());
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

SceneMesh read_mesh(const Json& json, const JsonPath& path, Mistakes& mistakes, MeshFiles& files) {
  ObjectReader object(json, path, mistakes);
  if (!object.is_object()) return {};
  const auto shading = read_shading(object);
  const Json* const named = object.find("materials");
  if (const Json* const file = object.find("file")) {
    const auto name = read_string(*file, object.path("file"), mistakes);
    const Json* const written = object.find("scale");
    const auto scale =
        written ? read_number(*written, object.path("scale"), mistakes, Range::positive) : 1.0;
    if (named && !named->is_object()) {
      mistakes.add(
          object.path("materials"),
          "must be an object of the file's materials and the scene's (" + found(*named) + ")");
      return {};
    }
    if (!object.finish() || !name || !scale || !shading) return {};
    SceneMesh mesh = files.read_mesh(*name, *scale, *shading, object.path("file"), mistakes);
    mesh.named = named;
    return mesh;
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
    if (!name) return {};
    if (*name == "front")
      sides = MeshSides::front;
    else if (*name != "both")
      mistakes.add(object.path("sides"), "must be \"both\" or \"front\" (" + found(*written) + ")");
  }
  if (named && !named->is_array()) {
    mistakes.add(object.path("materials"),
                 "must be a list of names of materials (" + found(*named) + ")");
    return {};
  }
  if (named) object.require("material_of", "a list of numbers of materials, one per triangle");
  object.allow({"normals", "normal_triangles", "uv", "uv_triangles", "material_of"});
  if (!object.finish() || !vertices || !triangles || !shading) return {};
  try {
    SceneMesh made;
    made.mesh =
        std::make_shared<const TriangleMesh>(std::move(*vertices), std::move(*triangles), sides);
    if (sides == MeshSides::front && !looks_one_way(*made.mesh)) {
      mistakes.add(object.path("sides"),
                   "must be \"both\" unless all triangles lie in one plane and face the same way");
      return {};
    }
    auto attributes =
        read_attributes(object, made.mesh->vertices(), made.mesh->triangles(), *shading);
    if (!attributes) return {};
    if (attributes->any())
      made.attributes = std::make_shared<const MeshAttributes>(std::move(*attributes));
    made.named = named;
    return made;
  } catch (const std::invalid_argument& error) {
    mistakes.add(path, error.what());
    return {};
  }
}

Json write_mesh(const TriangleMesh& mesh, const MeshLook* look, const Scene& scene) {
  Json json = {{"vertices", Json::array()}, {"triangles", Json::array()}};
  if (mesh.sides() == MeshSides::front) json["sides"] = "front";
  for (const Vec3<double>& vertex : mesh.vertices()) json["vertices"].push_back(to_json(vertex));
  for (const Corners& t : mesh.triangles())
    json["triangles"].push_back(Json::array({t[0], t[1], t[2]}));
  if (!look) return json;
  write_attributes(json, *look->attributes);
  if (look->attributes->material_of.empty() || look->materials.empty()) return json;
  // Materials by the places of their names, where numbers of none are left out.
  Json& names = json["materials"] = Json::array();
  std::vector<std::uint32_t> place(look->materials.size(), MeshAttributes::none);
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (look->materials[i] == MeshAttributes::none) continue;
    place[i] = static_cast<std::uint32_t>(names.size());
    names.push_back(scene.materials[look->materials[i]].name);
  }
  json["material_of"] = Json::array();
  for (const std::uint32_t number : look->attributes->material_of) {
    const bool has_one = number < place.size() && place[number] != MeshAttributes::none;
    json["material_of"].push_back(has_one ? Json(place[number]) : Json());
  }
  return json;
}

}  // namespace minkray
