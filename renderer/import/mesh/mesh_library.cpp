// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/mesh_library.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "core/files/regular_file.h"
#include "core/files/text.h"
#include "renderer/base/hash.h"
#include "renderer/base/of_file.h"
#include "renderer/import/mesh/collada.h"
#include "renderer/import/mesh/gltf.h"
#include "renderer/import/mesh/msh.h"
#include "renderer/import/model/mesh_surface.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

/// A mesh has a hull for each scale that it is shown at. Robots have one or two of them, and small
/// meshes may have more: Qhull takes up to 50 us for a vertex.
constexpr std::size_t most_scales = 8;
constexpr std::size_t most_rescaled_vertices = 1'000'000;

const MeshFormatReader* format_of(const std::filesystem::path& file) {
  for (const MeshFormatReader& format : mesh_formats())
    if (format.ending == lower_ending(file)) return &format;
  return nullptr;
}

std::string mesh_endings() {
  return listed(mesh_formats(), &MeshFormatReader::ending);
}

/// A format whose files contain vertices only.
template <MeshParts (*read)(const std::filesystem::path&, MeshSplit, MeshDetail)>
MeshContent bare(const std::filesystem::path& file, MeshSplit split, MeshDetail detail) {
  return {read(file, split, detail)};
}

MeshContent read_obj(const std::filesystem::path& file, MeshSplit split, MeshDetail detail) {
  MeshContent content{read_mesh_parts(file, split, detail)};
  content.looks = obj_looks(file, content.mesh.attributes.materials, content.materials);
  return content;
}

}  // namespace

const std::vector<MeshFormatReader>& mesh_formats() {
  static const std::vector<MeshFormatReader> formats = {
      {".obj", read_obj},     {".stl", bare<read_mesh_parts>}, {".msh", bare<read_msh>},
      {".dae", read_collada}, {".gltf", read_gltf_content},    {".glb", read_gltf_content},
  };
  return formats;
}

const MeshContent& MeshLibrary::read(const std::filesystem::path& file,
                                     const MeshFormatReader& format, MeshSplit split) {
  const auto known = read_.find({file.string(), split});
  if (known != read_.end()) return known->second;
  MeshContent content = format.read(
      file, split, options_->keeps_triangles() ? MeshDetail::attributes : MeshDetail::vertices);
  const std::vector<Vec3<double>>& vertices = content.mesh.vertices;
  Hash hash;
  hash.add({reinterpret_cast<const char*>(vertices.data()), vertices.size() * sizeof vertices[0]});
  const auto add = [&](const auto& items) {
    hash.add({reinterpret_cast<const char*>(items.data()), items.size() * sizeof items[0]});
  };
  if (content.mesh.attributes.any()) {
    add(content.mesh.attributes.normals);
    add(content.mesh.attributes.normal_of);
    add(content.mesh.attributes.uvs);
    add(content.mesh.attributes.uv_of);
    add(content.mesh.attributes.material_of);
  }
  hash_text_ += hash.text();
  read_vertices_ += vertices.size();
  files_.push_back(file);
  files_.insert(files_.end(), content.looks.files.begin(), content.looks.files.end());
  return read_.emplace(std::pair(file.string(), split), std::move(content)).first->second;
}

namespace {

/// The part of that name; nothing if there is none.
std::optional<std::size_t> part_named(const MeshContent& content, const std::string& name) {
  const std::vector<PartLook>& parts = content.looks.parts;
  for (std::size_t i = 0; i < std::min(parts.size(), content.mesh.parts.size()); ++i)
    if (std::ranges::find(parts[i].names, name) != parts[i].names.end()) return i;
  return std::nullopt;
}

/// The part by itself, around the origin if requested.
MeshContent part_of(const MeshContent& content, std::size_t part, bool is_centred) {
  MeshContent alone;
  for (const std::uint32_t i : content.mesh.parts[part])
    alone.mesh.vertices.push_back(content.mesh.vertices[i]);
  PartTriangles within = triangles_within(content.mesh, content.mesh.parts[part]);
  alone.mesh.triangles = std::move(within.corners);
  alone.mesh.attributes = std::move(within.attributes);
  alone.materials = content.materials;
  alone.looks.parts.push_back(content.looks.parts[part]);
  if (!is_centred) return alone;
  Vec3<double> lower = alone.mesh.vertices[0], upper = lower;
  for (const Vec3<double>& vertex : alone.mesh.vertices) {
    lower = lower.cwiseMin(vertex);
    upper = upper.cwiseMax(vertex);
  }
  const Vec3<double> middle = lower + (upper - lower) / 2;
  for (Vec3<double>& vertex : alone.mesh.vertices) vertex -= middle;
  return alone;
}

/// Gives parts their colours, or all of them that of most faces.
void take_looks(const MeshContent& content, MeshSplit split, MeshLibrary::Answer& answer) {
  const MeshLooks& looks = content.looks;
  answer.notes.insert(answer.notes.end(), looks.notes.begin(), looks.notes.end());
  const bool by_part = split == MeshSplit::groups && looks.parts.size() == answer.parts.size();
  for (std::size_t i = 0; i < answer.parts.size(); ++i)
    answer.parts[i].colour = by_part ? colour_of(looks.parts[i]) : colour_of(looks);
  const bool by_triangle = std::ranges::any_of(answer.parts, [](const MeshLibrary::Part& part) {
    return part.attributes && !part.attributes->material_of.empty();
  });
  if (const std::size_t count = colour_count(looks); count > 1 && !by_part && !by_triangle)
    answer.notes.push_back("has " + std::to_string(count) +
                           " colours: the most frequent one is used (or use --split groups)");
}

}  // namespace

std::optional<std::filesystem::path> MeshLibrary::find_also_in(
    const std::string& uri, const std::vector<std::filesystem::path>& also_in) {
  std::vector<std::filesystem::path> looked_for;
  std::optional<std::filesystem::path> file = places_.find(uri, also_in, looked_for);
  if (!file) return file;
  files_.push_back(*file);
  hash_text_ += file->string();
  return file;
}

const MeshLibrary::Answer& MeshLibrary::parts_of(
    const std::string& uri, const Vec3<double>& scale, const Submesh& submesh,
    const std::vector<std::filesystem::path>& also_in) {
  std::string key = uri + "\n" + submesh.name + (submesh.is_centred ? "\nc" : "\n");
  for (const double s : scale) key += " " + std::to_string(std::bit_cast<std::uint64_t>(s));
  const auto made = made_.find(key);
  if (made != made_.end()) return made->second;

  Answer answer;
  std::vector<std::filesystem::path> looked_for;
  std::optional<std::filesystem::path> file = places_.find(uri, also_in, looked_for);
  std::string title = uri;
  if (!file) {
    // Descriptions outlive their meshes' formats: the same name in another one will do.
    for (const std::filesystem::path& place : looked_for) {
      for (const MeshFormatReader& format : mesh_formats()) {
        std::filesystem::path other = place;
        other.replace_extension(format.ending);
        std::error_code error;
        if (!file && std::filesystem::is_regular_file(other, error)) file = other;
      }
    }
    if (file) title += " (found as " + file->filename().string() + ")";
  }
  if (!file) {
    answer.is_missing = true;
    answer.complaint = "the mesh \"" + printable(uri, 100) + "\" not found (searched: ";
    answer.complaint += list_of_places(looked_for) + ")";
    return made_[key] = answer;
  }
  const MeshFormatReader* format = format_of(*file);
  if (!format) {
    answer.complaint =
        "the mesh " + printable(file->string(), 160) + " must end in one of " + mesh_endings();
    return made_[key] = answer;
  }
  MeshContent content;
  MeshSplit split = options_->split;
  std::string note;
  try {
    const MeshContent& whole =
        read(*file, *format, submesh.name.empty() ? split : MeshSplit::groups);
    const auto part = submesh.name.empty() ? std::nullopt : part_named(whole, submesh.name);
    if (part) {
      content = part_of(whole, *part, submesh.is_centred);
      title += " (" + submesh.name + ")";
      split = MeshSplit::none;
    } else {
      content = read(*file, *format, split);
      if (!submesh.name.empty())
        note = "has no part \"" + printable(submesh.name, 60) + "\": the whole mesh is used";
    }
  } catch (const std::exception& error) {
    answer.complaint = "the mesh " + printable(file->string(), 160) + ": " + what_of(error);
    return made_[key] = answer;
  }
  shown_vertices_ += content.mesh.vertices.size();
  const std::size_t most = std::max(most_rescaled_vertices, most_scales * read_vertices_);
  if (shown_vertices_ > most) {
    answer.complaint = "the mesh \"" + printable(title, 100) + "\": with the meshes before, each " +
                       "once per scale, hulls must have at most " + std::to_string(most) +
                       " vertices (got " + std::to_string(shown_vertices_) + ")";
    return made_[key] = answer;
  }
  answer = add(content.mesh, scale, title);
  take_looks(content, split, answer);
  for (const std::string& text : notes_of(content.mesh.attributes)) answer.notes.push_back(text);
  answer.materials = read_pictures(std::move(content.materials), answer.notes);
  if (!note.empty()) answer.notes.push_back(note);
  answer.is_flattened = (scale.array() == 0).any();
  return made_[key] = answer;
}

MeshLibrary::Answer MeshLibrary::made_of(const MeshParts& mesh, const Vec3<double>& scale,
                                         const std::string& name) {
  Hash hash;
  hash.add({reinterpret_cast<const char*>(mesh.vertices.data()),
            mesh.vertices.size() * sizeof mesh.vertices[0]});
  hash_text_ += hash.text();
  return add(mesh, scale, name);
}

MeshLibrary::Answer MeshLibrary::add(const MeshParts& mesh, const Vec3<double>& scale,
                                     const std::string& name) {
  Answer answer;
  ModelMesh facts;
  facts.file = name;
  facts.vertices = mesh.vertices.size();
  Vec3<double> lower = mesh.vertices[0].cwiseProduct(scale), upper = lower;
  const auto add_part = [&](std::vector<Vec3<double>> vertices, PartTriangles triangles) {
    for (Vec3<double>& vertex : vertices) {
      vertex = vertex.cwiseProduct(scale);
      lower = lower.cwiseMin(vertex);
      upper = upper.cwiseMax(vertex);
    }
    Part part;
    const bool has_area = (scale.array() == 0).count() < 2;
    if (options_->keeps_triangles() && has_area) {
      MeshSurface surface = surface_of(vertices, std::move(triangles), scale);
      part.surface = std::move(surface.mesh);
      part.attributes = std::move(surface.attributes);
    }
    if (part.surface) {
      facts.parts.push_back({part.surface});
    } else {
      PointCloud hull(vertices);
      facts.parts.push_back({{}, hull, std::move(vertices)});
      part.hull = Hull{std::move(hull)};
      if (options_->meshes == MeshChoice::exact)
        answer.notes.emplace_back("has no triangles: its hull is used");
    }
    answer.parts.push_back(std::move(part));
  };
  try {
    if (mesh.parts.empty()) add_part(mesh.vertices, {mesh.triangles, mesh.attributes});
    for (const std::vector<std::uint32_t>& part : mesh.parts) {
      std::vector<Vec3<double>> vertices;
      vertices.reserve(part.size());
      for (const std::uint32_t i : part) vertices.push_back(mesh.vertices[i]);
      add_part(std::move(vertices), triangles_within(mesh, part));
    }
  } catch (const std::exception& error) {
    answer.complaint = "the mesh \"" + printable(name, 100) + "\": " + what_of(error);
    return answer;
  }
  facts.diameter = (upper - lower).maxCoeff();
  meshes_.push_back(facts);
  return answer;
}

MeshLibrary::Materials MeshLibrary::read_pictures(std::vector<MeshMaterial> materials,
                                                  std::vector<std::string>& notes) {
  if (materials.empty()) return nullptr;
  Hash hash;
  for (MeshMaterial& material : materials) {
    pictures_.read(material, notes);
    hash.add({reinterpret_cast<const char*>(material.rgba.data()), sizeof material.rgba});
    if (const auto& image = material.picture.image)
      hash.add({reinterpret_cast<const char*>(image->pixels.data()),
                image->pixels.size() * sizeof image->pixels[0]});
  }
  hash_text_ += hash.text();
  return std::make_shared<const std::vector<MeshMaterial>>(std::move(materials));
}

void MeshLibrary::hand_over(Model& model) {
  for (ModelMesh& mesh : meshes_) model.meshes.push_back(std::move(mesh));
  model.files.insert(model.files.end(), files_.begin(), files_.end());
  model.files.insert(model.files.end(), pictures_.files().begin(), pictures_.files().end());
  model.hash += hash_text_;
  meshes_.clear();
}

}  // namespace minkray
