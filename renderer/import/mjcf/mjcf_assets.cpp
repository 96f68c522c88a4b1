// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf/mjcf_assets.h"

#include <cmath>
#include <stdexcept>

#include "core/mesh/mapped.h"
#include "renderer/import/mesh/geometry_common.h"
#include "renderer/import/mjcf/mjcf_builtin.h"
#include "renderer/import/mjcf/mjcf_height_field.h"
#include "renderer/import/model/hull_mass.h"
#include "renderer/import/model/mesh_hull.h"
#include "renderer/import/model/orientation.h"

namespace minkray {
namespace {

constexpr Rgba default_rgba = {0.5, 0.5, 0.5, 1};

/// False if a number is of no vertex.
bool read_faces(const std::vector<double>& numbers, MeshParts& mesh) {
  if (numbers.size() % 3 != 0) return false;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const double number = numbers[i + k];
      if (!(number >= 0 && number < double(mesh.vertices.size())) || number != std::floor(number))
        return false;
      corners[k] = static_cast<std::uint32_t>(number);
    }
    mesh.triangles.push_back(corners);
  }
  return true;
}

}  // namespace

void MjcfAssets::look_in(const std::filesystem::path& file_folder,
                         const std::filesystem::path& mesh_folder, bool strips_path) {
  meshes_ = MeshLibrary(file_folder / mesh_folder, options_);
  mesh_folder_ = mesh_folder;
  strips_path_ = strips_path;
}

void MjcfAssets::read(const XmlElement& assets, const MjcfDefaults& defaults) {
  std::map<std::string, Rgba> textures;
  for (const XmlElement& asset : assets.children) {
    if (asset.name != "texture" || !asset.attribute("builtin")) continue;
    const auto one = files_.vector(asset, "rgb1"), two = files_.vector(asset, "rgb2");
    const Vec3<double> a = one.value_or(Vec3<double>::Constant(0.8)),
                       b = two.value_or(Vec3<double>::Constant(0.5));
    const bool is_flat = asset.attribute_or("builtin") == "flat";
    const Vec3<double> mean = is_flat ? a : Vec3<double>((a + b) / 2);
    textures[asset.attribute_or("name")] = {mean.x(), mean.y(), mean.z(), 1};
  }
  for (const XmlElement& written : assets.children) {
    const XmlElement asset = defaults.with_defaults(written, "", files_);
    if (asset.name == "mesh") {
      std::string name = asset.attribute_or("name");
      if (name.empty()) name = std::filesystem::path(asset.attribute_or("file")).stem().string();
      if (name.empty()) files_.wrong(written, "must have a name or a file");
      // As in MuJoCo: for a mesh, defaults set the scale only.
      if (asset.attribute("vertex") && !written.attribute("vertex"))
        files_.wrong(written, "vertex: must be in the <mesh> itself, not in its defaults");
      if (!mesh_assets_.emplace(name, asset).second) files_.wrong(written, "name: duplicate mesh");
    } else if (asset.name == "hfield") {
      std::string name = asset.attribute_or("name");
      if (name.empty()) name = std::filesystem::path(asset.attribute_or("file")).stem().string();
      height_fields_.emplace(name, asset);
    } else if (asset.name == "model") {
      std::string name = asset.attribute_or("name");
      if (name.empty()) name = std::filesystem::path(asset.attribute_or("file")).stem().string();
      models_.emplace(name, asset);
    } else if (asset.name == "material") {
      Rgba rgba = {1, 1, 1, 1};
      read_shapes(model_, files_, options_, [&] {
        if (const auto given = read_rgba(asset)) rgba = *given;
      });
      const auto texture = textures.find(asset.attribute_or("texture"));
      if (texture != textures.end())
        for (std::size_t i = 0; i < 3; ++i) rgba[i] *= texture->second[i];
      materials_[asset.attribute_or("name")] = rgba;
    } else {
      model_.pass_over("<" + printable(asset.name, 40) + ">",
                       asset.name == "texture" ? "surfaces have one colour" : "not a convex shape");
    }
  }
}

std::optional<Rgba> MjcfAssets::read_rgba(const XmlElement& element) const {
  const auto v = files_.numbers(element, "rgba", 3, 4);
  if (!v) return std::nullopt;
  return Rgba{(*v)[0], (*v)[1], (*v)[2], v->size() > 3 ? (*v)[3] : 1};
}

Rgba MjcfAssets::colour_of(const XmlElement& geom) const {
  const Rgba own = read_rgba(geom).value_or(default_rgba);
  const auto material = materials_.find(geom.attribute_or("material"));
  return own == default_rgba && material != materials_.end() ? material->second : own;
}

double MjcfAssets::alpha_for_rays(const XmlElement& geom) const {
  const auto material = materials_.find(geom.attribute_or("material"));
  return (material != materials_.end() ? material->second
                                       : read_rgba(geom).value_or(default_rgba))[3];
}

const MeshLibrary::Answer* MjcfAssets::mesh_of(const XmlElement& written, const XmlElement& e) {
  const std::string name = e.attribute_or("mesh");
  const auto found = mesh_assets_.find(name);
  if (found == mesh_assets_.end()) {
    files_.wrong(written, "mesh: no <mesh> is named \"" + printable(name, 60) + "\"");
    return nullptr;
  }
  const auto [at, is_new] = made_.try_emplace(name);
  if (is_new) at->second = parts_of(name, found->second);
  return &at->second;
}

void MjcfAssets::add_mesh_geom(const XmlElement& written, const XmlElement& e, ModelGeom geom) {
  if (options_.meshes == MeshChoice::of_format) geom.touches = Touch::as_hull;
  if (const MeshLibrary::Answer* mesh = mesh_of(written, e))
    add_mesh(model_, files_, written, *mesh, std::move(geom), options_);
}

std::optional<std::vector<double>> MjcfAssets::fit(const XmlElement& written, const XmlElement& e,
                                                   bool by_bounds, ModelGeom& geom) {
  const MeshLibrary::Answer* mesh = mesh_of(written, e);
  if (!mesh) return std::nullopt;
  if (mesh->parts.empty()) {
    // Reports a mistake in the mesh, or skips it.
    add_mesh(model_, files_, written, *mesh, geom, options_);
    return std::nullopt;
  }
  const MeshLibrary::Part& part = mesh->parts.front();
  const Shape shape = part.surface ? hull_of(*part.surface) : *part.hull;
  const auto* hull = std::get_if<Hull>(&shape.kind);
  const Mass mass = hull ? mass_of(hull->points) : Mass();
  if (mesh->parts.size() > 1 || !(mass.volume > 0)) {
    files_.wrong(written,
                 "mesh: a primitive is fitted to one mesh with a volume (without --split)");
    return std::nullopt;
  }
  const InertiaBox box = inertia_box(mass);
  geom.pose = geom.pose * box.pose;
  const double scale = files_.number(e, "fitscale").value_or(1);
  std::array<double, 3> half = box.half_sides;
  if (by_bounds) {
    Vec3<double> lower = Vec3<double>::Zero(), upper = lower;
    const Affine<double> to_box = box.pose.inverse();
    for (const Vec3<double>& point : hull->points.points()) {
      lower = lower.cwiseMin(to_box(point));
      upper = upper.cwiseMax(to_box(point));
    }
    geom.pose = geom.pose * Affine<double>{Mat3<double>::Identity(), (lower + upper) / 2};
    for (int i = 0; i < 3; ++i) half[static_cast<std::size_t>(i)] = (upper[i] - lower[i]) / 2;
  }
  std::vector<double> size(half.begin(), half.end());
  if (geom.kind == "sphere")
    size[0] = by_bounds ? std::max({half[0], half[1], half[2]}) : (half[0] + half[1] + half[2]) / 3;
  if (geom.kind == "capsule" || geom.kind == "cylinder") {
    size[0] = by_bounds ? std::max(half[0], half[1]) : (half[0] + half[1]) / 2;
    size[1] = half[2];
    // MuJoCo takes half a radius off where it fits by inertia.
    if (geom.kind == "capsule") size[1] = std::max(0.0, half[2] - size[0] / (by_bounds ? 1 : 2));
  }
  for (double& one : size) one *= scale;
  return size;
}

MeshLibrary::Answer MjcfAssets::parts_of(const std::string& name, const XmlElement& asset) {
  const Vec3<double> scale = files_.vector(asset, "scale").value_or(Vec3<double>::Ones());
  MeshLibrary::Answer answer;
  // Vertices are moved and turned before they are scaled.
  Affine<double> before;
  if (const auto q = files_.numbers(asset, "refquat", 4, 4))
    before.linear = rotation_of_quaternion((*q)[1], (*q)[2], (*q)[3], (*q)[0]).transpose();
  if (const auto p = files_.vector(asset, "refpos")) before.translation = -(before.linear * *p);
  const bool moves = !(before == Affine<double>());
  const Vec3<double> scale_of_vertices = moves ? Vec3<double>::Ones() : scale;
  if (asset.attribute("vertex")) {
    const auto numbers = files_.numbers(asset, "vertex", 12, 3'000'000);
    if (!numbers) return answer;  // already reported
    std::vector<Vec3<double>> vertices;
    for (std::size_t i = 0; i + 2 < numbers->size(); i += 3)
      vertices.emplace_back((*numbers)[i], (*numbers)[i + 1], (*numbers)[i + 2]);
    MeshParts mesh{std::move(vertices)};
    if (const auto faces = files_.numbers(asset, "face", 3, 3'000'000)) {
      if (!read_faces(*faces, mesh)) {
        files_.wrong(asset, "face: must be numbers of vertices, three for each triangle");
        return answer;
      }
    }
    answer = meshes_.made_of(mesh, scale_of_vertices, name);
  } else if (const std::string* builtin = asset.attribute("builtin")) {
    const auto params = files_.numbers(asset, "params", 1, 5);
    try {
      answer = meshes_.made_of({builtin_mesh(*builtin, params.value_or(std::vector<double>()))},
                               scale_of_vertices, name);
    } catch (const std::runtime_error& error) {
      answer.complaint = std::string("<mesh>: ") + error.what();
    }
  } else {
    answer = meshes_.parts_of(name_of_file(asset), scale_of_vertices, {}, folders_of(asset));
  }
  if (moves)
    for (MeshLibrary::Part& part : answer.parts) {
      const Affine<double> map = Affine<double>{scale.asDiagonal(), {0, 0, 0}} * before;
      if (part.hull) part.hull = Transform{*part.hull, map};
      if (part.surface) part.surface = mapped(*part.surface, map);
      if (part.attributes) {
        MeshAttributes moved = *part.attributes;
        map_normals(moved, map.linear.inverse().transpose());
        if (map.linear.determinant() < 0) swap_corners(moved);
        settle(moved);
        part.attributes = std::make_shared<const MeshAttributes>(std::move(moved));
      }
    }
  return answer;
}

std::string MjcfAssets::name_of_file(const XmlElement& asset) const {
  const std::string file = asset.attribute_or("file");
  return strips_path_ ? std::filesystem::path(file).filename().string() : file;
}

/// An included file may have its meshes next to it.
std::vector<std::filesystem::path> MjcfAssets::folders_of(const XmlElement& asset) const {
  const std::filesystem::path own = files_.files()[asset.file].parent_path();
  return {own / mesh_folder_, own};
}

void MjcfAssets::add_height_field(const XmlElement& written, const XmlElement& e, ModelGeom geom) {
  const std::string name = e.attribute_or("hfield");
  const auto found = height_fields_.find(name);
  if (found == height_fields_.end())
    return files_.wrong(written, "hfield: no <hfield> is named \"" + printable(name, 60) + "\"");
  const XmlElement& asset = found->second;
  const auto [at, is_new] = terrains_.try_emplace(name);
  if (is_new)
    at->second = mjcf_height_field(asset, files_, [&](const std::string&) {
      return meshes_.find_also_in(name_of_file(asset), folders_of(asset));
    });
  geom.mesh = at->second;
  if (geom.mesh) model_.geoms.push_back(std::move(geom));
}

void MjcfAssets::hand_over_meshes() {
  meshes_.hand_over(model_);
}

}  // namespace minkray
