// SPDX-License-Identifier: MIT
#include "renderer/import/mesh_library.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "renderer/base/hash.h"
#include "renderer/import/collada.h"
#include "renderer/import/gltf.h"
#include "renderer/import/msh.h"
#include "renderer/import/plane_tree.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

/// A mesh has a hull for each scale that it is shown at. Robots have one or two of them, and small
/// meshes may have more: Qhull takes up to 50 us for a vertex.
constexpr std::size_t most_scales = 8;
constexpr std::size_t most_rescaled_vertices = 1'000'000;

std::string lower_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

const MeshFormatReader* format_of(const std::filesystem::path& file) {
  for (const MeshFormatReader& format : mesh_formats())
    if (format.ending == lower_ending(file)) return &format;
  return nullptr;
}

std::string mesh_endings() {
  std::string text;
  for (const MeshFormatReader& format : mesh_formats())
    text += (text.empty() ? "" : ", ") + std::string(format.ending);
  return text;
}

/// How far vertices lie below the surface of their hull at most: of a convex mesh, 0 but for
/// rounding.
double deepest_below(const std::vector<Vec3<double>>& vertices, const PointCloud<double>& hull) {
  const FacetMesh<double>* facets = hull.facets();
  if (!facets) return 0;
  Vec3<double> lower = hull.points()[0], upper = lower;
  for (const Vec3<double>& vertex : hull.points()) {
    lower = lower.cwiseMin(vertex);
    upper = upper.cwiseMax(vertex);
  }
  const Vec3<double> half = (upper - lower) / 2, centre = lower + half;
  std::vector<PlaneTree::Plane> planes;
  for (std::size_t i = 0; i < facets->size(); ++i) {
    const Vec3<double> n = (*facets)[i].normal();
    if (!n.isZero(0))
      planes.push_back({n.x(), n.y(), n.z(), n.dot((*facets)[i].corner(0) - centre)});
  }
  const PlaneTree tree(std::move(planes), half.maxCoeff());
  double deepest = 0;
  // The hull has its own points in the vertices' order; they lie below nothing.
  auto own = hull.points().begin();
  for (const Vec3<double>& vertex : vertices) {
    if (own != hull.points().end() && vertex == *own) {
      ++own;
      continue;
    }
    const double depth = tree.least_depth(vertex - centre, deepest);
    if (std::isfinite(depth)) deepest = std::max(deepest, depth);
  }
  return deepest;
}

}  // namespace

const std::vector<MeshFormatReader>& mesh_formats() {
  static const std::vector<MeshFormatReader> formats = {
      {".obj", read_mesh_parts}, {".stl", read_mesh_parts}, {".msh", read_msh},
      {".dae", read_collada},    {".gltf", read_gltf_mesh}, {".glb", read_gltf_mesh},
  };
  return formats;
}

std::string list_of_places(const std::vector<std::filesystem::path>& places) {
  constexpr std::size_t longest = 360;
  std::string text;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string place = printable(places[i].string(), 160);
    if (text.size() + place.size() > longest)
      return text + " and " + std::to_string(places.size() - i) + " more places";
    text += (i > 0 ? ", " : "") + place;
  }
  return text;
}

std::optional<std::filesystem::path> MeshLibrary::find(
    const std::string& uri, std::vector<std::filesystem::path>& looked_for) const {
  const auto look_at = [&](const std::filesystem::path& place) {
    const std::filesystem::path normal = place.lexically_normal();
    if (std::ranges::find(looked_for, normal) == looked_for.end()) looked_for.push_back(normal);
  };
  const auto begins = [&](std::string_view scheme) { return uri.starts_with(scheme); };
  if (begins("package://") || begins("model://")) {
    const std::string rest = uri.substr(uri.find("://") + 3);
    const std::string in_package = rest.substr(std::min(rest.find('/') + 1, rest.size()));
    for (const std::string& folder : options_->package_dirs) {
      look_at(std::filesystem::path(folder) / rest);
      look_at(std::filesystem::path(folder) / in_package);
      look_at(std::filesystem::path(folder) / std::filesystem::path(rest).filename());
    }
    // Packages lie in a folder of their name, beside or above the file.
    std::filesystem::path folder =
        std::filesystem::absolute(folder_.empty() ? "." : folder_).lexically_normal();
    for (int i = 0; i < 8; ++i) {
      look_at(folder / rest);
      if (folder == folder.parent_path()) break;
      folder = folder.parent_path();
    }
  } else if (begins("file://")) {
    look_at(uri.substr(std::string_view("file://").size()));
    look_at(folder_ / uri.substr(std::string_view("file://").size()));
  } else {
    look_at(folder_ / uri);
    for (const std::string& folder : options_->package_dirs) {
      look_at(std::filesystem::path(folder) / uri);
      look_at(std::filesystem::path(folder) / std::filesystem::path(uri).filename());
    }
  }
  std::error_code error;
  for (const std::filesystem::path& place : looked_for)
    if (std::filesystem::is_regular_file(place, error)) return place;
  return std::nullopt;
}

const MeshLibrary::Answer& MeshLibrary::hulls_of(const std::string& uri,
                                                 const Vec3<double>& scale) {
  std::string key = uri;
  for (const double s : scale) key += " " + std::to_string(std::bit_cast<std::uint64_t>(s));
  const auto made = made_.find(key);
  if (made != made_.end()) return made->second;

  Answer answer;
  std::vector<std::filesystem::path> looked_for;
  std::optional<std::filesystem::path> file = find(uri, looked_for);
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
    if (file) title += " (there as " + file->filename().string() + ")";
  }
  if (!file) {
    answer.is_missing = true;
    answer.complaint = "the mesh \"" + printable(uri, 100) + "\" is not there (looked for ";
    answer.complaint += list_of_places(looked_for) + ")";
    return made_[key] = answer;
  }
  const MeshFormatReader* format = format_of(*file);
  if (!format) {
    answer.complaint =
        "the mesh " + printable(file->string(), 160) + " must end in one of " + mesh_endings();
    return made_[key] = answer;
  }
  auto known = read_.find(file->string());
  if (known == read_.end()) {
    try {
      MeshParts parts = format->read(*file, options_->split);
      Hash hash;
      hash.add({reinterpret_cast<const char*>(parts.vertices.data()),
                parts.vertices.size() * sizeof parts.vertices[0]});
      hash_text_ += hash.text();
      read_vertices_ += parts.vertices.size();
      known = read_.emplace(file->string(), std::move(parts)).first;
    } catch (const std::exception& error) {
      answer.complaint = "the mesh " + printable(file->string(), 160) + ": " + error.what();
      return made_[key] = answer;
    }
  }
  shown_vertices_ += known->second.vertices.size();
  const std::size_t most = std::max(most_rescaled_vertices, most_scales * read_vertices_);
  if (shown_vertices_ > most) {
    answer.complaint = "the mesh \"" + printable(title, 100) + "\": with the meshes before, each " +
                       "once for each of its scales, hulls are made of at most " +
                       std::to_string(most) + " vertices (got " + std::to_string(shown_vertices_) +
                       ")";
    return made_[key] = answer;
  }
  return made_[key] = add(known->second, scale, title);
}

MeshLibrary::Answer MeshLibrary::hulls_of_parts(const MeshParts& mesh, const Vec3<double>& scale,
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
  facts.parts = std::max<std::size_t>(mesh.parts.size(), 1);
  Vec3<double> lower = mesh.vertices[0].cwiseProduct(scale), upper = lower;
  const auto add_part = [&](std::vector<Vec3<double>> vertices) {
    for (Vec3<double>& vertex : vertices) {
      vertex = vertex.cwiseProduct(scale);
      lower = lower.cwiseMin(vertex);
      upper = upper.cwiseMax(vertex);
    }
    PointCloud<double> hull(vertices);
    facts.corners += hull.points().size();
    facts.deepest = std::max(facts.deepest, deepest_below(vertices, hull));
    answer.hulls.emplace_back(Hull<double>{std::move(hull)});
  };
  try {
    if (mesh.parts.empty()) add_part(mesh.vertices);
    for (const std::vector<std::uint32_t>& part : mesh.parts) {
      std::vector<Vec3<double>> vertices;
      vertices.reserve(part.size());
      for (const std::uint32_t i : part) vertices.push_back(mesh.vertices[i]);
      add_part(std::move(vertices));
    }
  } catch (const std::exception& error) {
    answer.complaint = "the mesh \"" + printable(name, 100) + "\": " + error.what();
    return answer;
  }
  facts.diameter = (upper - lower).maxCoeff();
  meshes_.push_back(facts);
  return answer;
}

}  // namespace minkray
