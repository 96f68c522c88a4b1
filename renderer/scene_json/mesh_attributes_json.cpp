// SPDX-License-Identifier: MIT
#include "renderer/scene_json/mesh_attributes_json.h"

#include <numbers>

#include "renderer/json/values.h"

namespace minkray {
namespace {

using Numbers = MeshAttributes::Numbers;
constexpr std::size_t most_attributes = std::size_t{1} << 30;

/// True if the key holds a list of `count` items; else a mistake.
bool has_items(const Json& json, const JsonPath& path, Mistakes& mistakes, std::size_t count,
               const char* what) {
  if (json.is_array() && json.size() == count) return true;
  mistakes.add(path, "must be a list of " + std::to_string(count) + " items, one per " + what +
                         " (" + found(json) + ")");
  return false;
}

bool is_number_below(const Json& json, std::size_t end) {
  return json.is_number_unsigned() && json.get<std::uint64_t>() < end;
}

/// Reads three numbers of items per triangle, or null where it has none. Without a list, items are
/// those of the vertices, which must then be as many.
std::optional<std::vector<Numbers>> read_numbers_of(ObjectReader& mesh, const char* key,
                                                    std::size_t items, const char* of_items,
                                                    std::size_t vertices,
                                                    std::span<const Numbers> triangles) {
  const Json* written = mesh.find(key);
  if (!written) {
    if (items == vertices) return std::vector<Numbers>(triangles.begin(), triangles.end());
    mesh.mistakes().add(mesh.path(of_items), "must be one per vertex, " + std::to_string(vertices) +
                                                 ", without \"" + key + "\" (got " +
                                                 std::to_string(items) + ")");
    return std::nullopt;
  }
  if (!has_items(*written, mesh.path(key), mesh.mistakes(), triangles.size(), "triangle"))
    return std::nullopt;
  std::vector<Numbers> all;
  all.reserve(triangles.size());
  for (std::size_t i = 0; i < written->size(); ++i) {
    const Json& json = (*written)[i];
    Numbers& numbers = all.emplace_back(MeshAttributes::no_numbers);
    if (json.is_null()) continue;
    bool is_good = json.is_array() && json.size() == 3;
    for (std::size_t k = 0; k < 3 && is_good; ++k) {
      is_good = is_number_below(json[k], items);
      if (is_good) numbers[k] = static_cast<std::uint32_t>(json[k].get<std::uint64_t>());
    }
    if (is_good) continue;
    mesh.mistakes().add(mesh.path(key) / i, "must be null or three numbers of \"" +
                                                std::string(of_items) + "\", less than " +
                                                std::to_string(items) + " (" + found(json) + ")");
    return std::nullopt;
  }
  return all;
}

bool read_normals(ObjectReader& mesh, const Json& written, MeshAttributes& made) {
  const auto points =
      read_points(written, mesh.path("normals"), mesh.mistakes(), 1, most_attributes);
  if (!points) return false;
  for (std::size_t i = 0; i < points->size(); ++i) {
    made.normals.push_back(attribute_normal((*points)[i]));
    if (!made.normals.back().isZero(0)) continue;
    mesh.mistakes().add(mesh.path("normals") / i, "must not be zero");
    return false;
  }
  return true;
}

bool read_uvs(ObjectReader& mesh, const Json& written, MeshAttributes& made) {
  if (!written.is_array() || written.empty()) {
    mesh.mistakes().add(mesh.path("uv"),
                        "must be a list of two numbers each (" + found(written) + ")");
    return false;
  }
  for (std::size_t i = 0; i < written.size(); ++i) {
    const auto uv = read_numbers(written[i], mesh.path("uv") / i, mesh.mistakes(), 2);
    if (!uv) return false;
    made.uvs.push_back({static_cast<float>((*uv)[0]), static_cast<float>((*uv)[1])});
  }
  return true;
}

bool read_material_of(ObjectReader& mesh, const Json& written, std::size_t triangles,
                      MeshAttributes& made) {
  if (!has_items(written, mesh.path("material_of"), mesh.mistakes(), triangles, "triangle"))
    return false;
  const Json* names = mesh.find("materials");
  const std::size_t count = names && names->is_array() ? names->size() : 0;
  if (!names) {
    mesh.mistakes().add(mesh.path("material_of"), "not allowed without \"materials\"");
    return false;
  }
  for (std::size_t i = 0; i < written.size(); ++i) {
    const bool has_none = written[i].is_null();
    if (!has_none && !is_number_below(written[i], count)) {
      mesh.mistakes().add(mesh.path("material_of") / i,
                          "must be null or the number of one of the " + std::to_string(count) +
                              " materials (" + found(written[i]) + ")");
      return false;
    }
    made.material_of.push_back(has_none
                                   ? MeshAttributes::none
                                   : static_cast<std::uint32_t>(written[i].get<std::uint64_t>()));
  }
  return true;
}

Json numbers_json(const std::vector<Numbers>& of) {
  Json list = Json::array();
  for (const Numbers& n : of)
    list.push_back(n[0] == MeshAttributes::none ? Json() : Json::array({n[0], n[1], n[2]}));
  return list;
}

}  // namespace

std::optional<MeshShading> read_shading(ObjectReader& mesh) {
  const Json* written = mesh.find("smooth");
  if (!written) return MeshShading();
  if (written->is_boolean())
    return written->get<bool>() ? MeshShading{MeshShading::smooth, std::numbers::pi}
                                : MeshShading{MeshShading::flat};
  if (written->is_number()) {
    const auto degrees =
        read_number(*written, mesh.path("smooth"), mesh.mistakes(), Range::positive);
    if (!degrees) return std::nullopt;
    if (*degrees <= 180) return MeshShading{MeshShading::smooth, *degrees * std::numbers::pi / 180};
  }
  mesh.mistakes().add(mesh.path("smooth"),
                      "must be true, false, or the largest smooth angle in degrees, at most 180 (" +
                          found(*written) + ")");
  return std::nullopt;
}

std::optional<MeshAttributes> read_attributes(ObjectReader& mesh,
                                              std::span<const Vec3<double>> vertices,
                                              std::span<const Numbers> triangles,
                                              const MeshShading& shading) {
  MeshAttributes made;
  const Json* normals = mesh.find("normals");
  if (normals && mesh.find("smooth")) {
    mesh.mistakes().add(mesh.path("smooth"), "not allowed together with \"normals\"");
    return std::nullopt;
  }
  if (normals) {
    if (!read_normals(mesh, *normals, made)) return std::nullopt;
    auto of = read_numbers_of(mesh, "normal_triangles", made.normals.size(), "normals",
                              vertices.size(), triangles);
    if (!of) return std::nullopt;
    made.normal_of = std::move(*of);
  } else if (shading.kind == MeshShading::smooth) {
    made = smooth_normals(vertices, triangles, shading.crease);
  }
  if (const Json* uvs = mesh.find("uv")) {
    if (!read_uvs(mesh, *uvs, made)) return std::nullopt;
    auto of =
        read_numbers_of(mesh, "uv_triangles", made.uvs.size(), "uv", vertices.size(), triangles);
    if (!of) return std::nullopt;
    made.uv_of = std::move(*of);
  }
  if (const Json* of = mesh.find("material_of"))
    if (!read_material_of(mesh, *of, triangles.size(), made)) return std::nullopt;
  settle(made);
  return made;
}

void write_attributes(Json& mesh, const MeshAttributes& attributes) {
  if (!attributes.normal_of.empty()) {
    mesh["normals"] = Json::array();
    for (const Vec3<float>& n : attributes.normals)
      mesh["normals"].push_back(Json::array({double{n.x()}, double{n.y()}, double{n.z()}}));
    mesh["normal_triangles"] = numbers_json(attributes.normal_of);
  }
  if (!attributes.uv_of.empty()) {
    mesh["uv"] = Json::array();
    for (const std::array<float, 2>& uv : attributes.uvs)
      mesh["uv"].push_back(Json::array({double{uv[0]}, double{uv[1]}}));
    mesh["uv_triangles"] = numbers_json(attributes.uv_of);
  }
}

}  // namespace minkray
