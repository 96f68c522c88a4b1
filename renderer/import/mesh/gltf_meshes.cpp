// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/gltf_meshes.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "renderer/image/colour.h"
#include "renderer/import/mesh/mesh_library.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

using GltfTriangle = std::array<std::uint32_t, 3>;

/// Modes by which a primitive's indices make triangles.
constexpr std::size_t mode_triangles = 4, mode_fan = 6;

/// Strips turn over at every other triangle.
std::vector<GltfTriangle> triangles_of(const std::vector<std::uint32_t>& corners,
                                       std::size_t mode) {
  std::vector<GltfTriangle> all;
  const std::size_t step = mode == mode_triangles ? 3 : 1;
  for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
    all.push_back({mode == mode_fan ? corners[0] : corners[i], corners[i + 1], corners[i + 2]});
    if (mode != mode_fan && step == 1 && i % 2 == 1) std::swap(all.back()[1], all.back()[2]);
  }
  return all;
}

/// The file's lists of numbers, whose items may be anything.
std::vector<std::size_t> indices_in(GltfDocument& document, const Json& object,
                                    const JsonPath& path, std::string_view key,
                                    std::string_view list) {
  std::vector<std::size_t> indices;
  const Json* written = object.find(key);
  if (!written) return indices;
  if (!written->is_array()) {
    document.mistakes().add(path / key, "must be a list (" + found(*written) + ")");
    return indices;
  }
  for (std::size_t i = 0; i < written->size(); ++i) {
    if (const auto index = document.index_of((*written)[i], path / key / i, list))
      indices.push_back(*index);
  }
  return indices;
}

}  // namespace

Affine<double> gltf_z_up() {
  Affine<double> turn;
  turn.linear << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return turn;
}

const MeshParts& GltfMeshes::mesh(const GltfMeshUse& use) {
  return read(use).parts;
}

const std::vector<std::size_t>& GltfMeshes::primitives_of_parts(const GltfMeshUse& use) {
  return read(use).primitives;
}

const GltfMeshes::Read& GltfMeshes::read(const GltfMeshUse& use) {
  const auto known = read_.find(use);
  if (known != read_.end()) return known->second;
  Read& read = read_[use];
  const JsonPath path = JsonPath() / "meshes" / use.mesh / "primitives";
  const Json* primitives = document_.item("meshes", use.mesh).find("primitives");
  if (!primitives || !primitives->is_array()) {
    document_.mistakes().add(path, "must be a list");
    return read;
  }
  for (std::size_t i = 0; i < primitives->size(); ++i) {
    if ((*primitives)[i].is_object())
      add_primitive((*primitives)[i], path / i, i, use.weights, read);
    else
      document_.mistakes().add(path / i, "must be an object (" + found((*primitives)[i]) + ")");
  }
  return read;
}

/// Adds the displacements of a primitive's morph targets to its points, times their weights.
/// False, and a mistake, if they cannot be read.
bool GltfMeshes::add_targets(const Json& primitive, const JsonPath& path,
                             const std::vector<double>& weights,
                             std::vector<Vec3<double>>& points) {
  const Json* targets = primitive.find("targets");
  if (!targets || !targets->is_array()) return true;
  for (std::size_t i = 0; i < std::min(targets->size(), weights.size()); ++i) {
    if (weights[i] == 0 || !(*targets)[i].is_object()) continue;
    const auto accessor =
        document_.index((*targets)[i], path / "targets" / i, "POSITION", "accessors");
    if (!accessor) continue;
    const auto moves = document_.points(*accessor);
    if (!moves) return false;
    if (moves->size() != points.size()) {
      document_.mistakes().add(path / "targets" / i, "must have as many points as the primitive");
      return false;
    }
    for (std::size_t k = 0; k < points.size(); ++k) points[k] += weights[i] * (*moves)[k];
  }
  return true;
}

void GltfMeshes::add_primitive(const Json& primitive, const JsonPath& path, std::size_t number,
                               const std::vector<double>& weights, Read& read) {
  std::size_t mode = mode_triangles;
  if (const Json* written = primitive.find("mode")) {
    const auto value = read_integer(*written, path / "mode", document_.mistakes(), 0, mode_fan);
    if (!value) return;
    mode = static_cast<std::size_t>(*value);
  }
  if (mode < mode_triangles) {
    ++left_out_;
    return;
  }
  const Json* attributes = primitive.find("attributes");
  const auto accessor =
      attributes ? document_.index(*attributes, path / "attributes", "POSITION", "accessors")
                 : std::nullopt;
  if (!accessor) {
    if (!attributes || !attributes->is_object() || !attributes->contains("POSITION"))
      document_.mistakes().add(path / "attributes", "must have a \"POSITION\"");
    return;
  }
  auto points = document_.points(*accessor);
  if (!points || !add_targets(primitive, path, weights, *points)) return;
  std::vector<std::uint32_t> corners(points->size());
  std::iota(corners.begin(), corners.end(), 0u);
  if (primitive.contains("indices")) {
    const auto index = document_.index(primitive, path, "indices", "accessors");
    auto indices = index ? document_.indices(*index, points->size()) : std::nullopt;
    if (!indices) return;
    corners = std::move(*indices);
  }
  // Buffers may hold what other meshes use: only the corners' points are shown.
  std::vector<std::uint32_t> used = corners;
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  vertices_ += used.size();
  if (has_too_many(vertices_)) return;
  MeshParts& mesh = read.parts;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const std::uint32_t i : used) mesh.vertices.push_back((*points)[i]);
  read.corners.emplace_back(number, corners.size());
  for (std::uint32_t& corner : corners)
    corner = static_cast<std::uint32_t>(std::ranges::lower_bound(used, corner) - used.begin());
  const std::vector<GltfTriangle> triangles = triangles_of(corners, mode);
  if (detail_ == MeshDetail::attributes) {
    MeshAttributes made = looks_.attributes_of(primitive, path, points->size(), used, triangles);
    // Normals are those of the shape before it is morphed.
    if (!weights.empty()) made.normal_of.clear();
    append(mesh.attributes, mesh.triangles.size(), made, triangles.size(), 0);
  }
  for (const GltfTriangle& t : triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  if (split_ == MeshSplit::groups) {
    std::vector<std::uint32_t>& part = mesh.parts.emplace_back(used.size());
    std::iota(part.begin(), part.end(), first);
    read.primitives.push_back(number);
  } else if (split_ == MeshSplit::components) {
    const auto own = std::span(mesh.vertices).subspan(first);
    for (std::vector<std::uint32_t>& part : components_of(own, triangles)) {
      for (std::uint32_t& i : part) i += first;
      mesh.parts.push_back(std::move(part));
    }
  }
}

Affine<double> gltf_pose(GltfDocument& document, std::size_t node) {
  const Json& json = document.item("nodes", node);
  const JsonPath path = JsonPath() / "nodes" / node;
  const auto numbers = [&](const char* key, std::size_t count) {
    const Json* written = json.find(key);
    return written ? read_numbers(*written, path / key, document.mistakes(), count) : std::nullopt;
  };
  Affine<double> pose;
  if (const auto m = numbers("matrix", 16)) {
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row)
        pose.linear(row, column) = (*m)[static_cast<std::size_t>(4 * column + row)];
    pose.translation = {(*m)[12], (*m)[13], (*m)[14]};
    if ((*m)[3] != 0 || (*m)[7] != 0 || (*m)[11] != 0 || (*m)[15] != 1)
      document.mistakes().add(path / "matrix", "must have a last row of 0, 0, 0, 1");
    return pose;
  }
  if (const auto t = numbers("translation", 3)) pose.translation = {(*t)[0], (*t)[1], (*t)[2]};
  if (const auto q = numbers("rotation", 4)) {
    if ((*q)[0] == 0 && (*q)[1] == 0 && (*q)[2] == 0 && (*q)[3] == 0)
      document.mistakes().add(path / "rotation", "must not be zero");
    else
      pose.linear = rotation_matrix_of_any((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
  }
  if (const auto s = numbers("scale", 3))
    pose.linear = pose.linear * Vec3<double>((*s)[0], (*s)[1], (*s)[2]).asDiagonal();
  return pose;
}

std::vector<std::size_t> gltf_children(GltfDocument& document, std::size_t node) {
  return indices_in(document, document.item("nodes", node), JsonPath() / "nodes" / node, "children",
                    "nodes");
}

std::vector<std::size_t> gltf_roots(GltfDocument& document) {
  const std::size_t count = document.count("nodes");
  std::vector<char> has_parent(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!document.item("nodes", i).is_object()) {
      document.mistakes().add(JsonPath() / "nodes" / i, "must be an object");
      continue;
    }
    for (const std::size_t child : gltf_children(document, i)) {
      if (has_parent[child])
        document.mistakes().add(JsonPath() / "nodes" / child, "must not be a child twice");
      has_parent[child] = 1;
    }
  }
  std::vector<std::size_t> roots;
  if (document.count("scenes") > 0) {
    std::size_t scene = 0;
    if (document.root()->contains("scene"))
      scene = document.index(*document.root(), JsonPath(), "scene", "scenes").value_or(0);
    if (document.item("scenes", scene).is_object())
      roots = indices_in(document, document.item("scenes", scene), JsonPath() / "scenes" / scene,
                         "nodes", "nodes");
    // A node in a circle has a parent, so that no walk from these ends where it began.
    for (const std::size_t root : roots)
      if (has_parent[root])
        document.mistakes().add(
            JsonPath() / "scenes" / scene / "nodes",
            "must be nodes without a parent (got " + std::to_string(root) + ")");
  } else {
    for (std::size_t i = 0; i < count; ++i)
      if (!has_parent[i]) roots.push_back(i);
  }
  return document.mistakes().none() ? roots : std::vector<std::size_t>();
}

/// True, and reports an error, if the file may not have or show this many vertices.
bool GltfMeshes::has_too_many(std::size_t vertices) {
  constexpr std::size_t bytes_of_number = 4;
  const std::size_t most = std::min(
      most_gltf_vertices, most_shown_vertices(document_.bytes_of_buffers() / bytes_of_number));
  if (vertices <= most) return false;
  document_.mistakes().add(JsonPath() / "meshes",
                           "must have at most " + std::to_string(most) + " vertices, of " +
                               std::to_string(document_.bytes_of_buffers()) +
                               " bytes of buffers (got " + std::to_string(vertices) + ")");
  return true;
}

std::vector<Affine<double>> gltf_instances(GltfDocument& document, std::size_t node) {
  const Json& json = document.item("nodes", node);
  const JsonPath path = JsonPath() / "nodes" / node / "extensions" / "EXT_mesh_gpu_instancing";
  const Json* at = json.find("extensions");
  at = at && at->is_object() ? at->find("EXT_mesh_gpu_instancing") : nullptr;
  const Json* attributes = at && at->is_object() ? at->find("attributes") : nullptr;
  if (!attributes || !attributes->is_object()) return {Affine<double>()};
  const auto accessor = [&](std::string_view key) {
    return document.index(*attributes, path / "attributes", key, "accessors");
  };
  std::optional<std::size_t> count;
  bool agree = true;
  const auto counted = [&](std::size_t size) {
    agree &= !count || *count == size;
    count = size;
  };
  std::optional<std::vector<Vec3<double>>> translations, scales;
  std::optional<std::vector<std::array<double, 4>>> rotations;
  if (const auto t = accessor("TRANSLATION")) translations = document.points(*t);
  if (const auto r = accessor("ROTATION")) rotations = document.quaternions(*r);
  if (const auto s = accessor("SCALE")) scales = document.points(*s);
  if (translations) counted(translations->size());
  if (rotations) counted(rotations->size());
  if (scales) counted(scales->size());
  if (!count || !agree) {
    document.mistakes().add(path / "attributes",
                            "must have TRANSLATION, ROTATION or SCALE, all of one count");
    return {};
  }
  std::vector<Affine<double>> poses(*count);
  for (std::size_t i = 0; i < *count; ++i) {
    if (translations) poses[i].translation = (*translations)[i];
    if (rotations) {
      const auto [x, y, z, w] = (*rotations)[i];
      poses[i].linear = rotation_matrix_of_any(x, y, z, w);
    }
    if (scales) poses[i].linear = poses[i].linear * (*scales)[i].asDiagonal();
  }
  return poses;
}

void GltfMeshes::add_shown(std::span<const std::size_t> nodes, const Affine<double>& pose,
                           bool with_own_pose, MeshParts& all, MeshLooks* looks) {
  struct Open {
    std::size_t node;
    Affine<double> pose;
  };
  std::vector<Open> open;
  for (const std::size_t node : nodes)
    open.push_back({node, with_own_pose ? pose * gltf_pose(document_, node) : pose});
  // A node that a collider names may be in a circle.
  std::size_t visits = 0;
  while (!open.empty()) {
    const Open at = open.back();
    open.pop_back();
    const JsonPath path = JsonPath() / "nodes" / at.node;
    if (++visits > document_.count("nodes"))
      return document_.mistakes().add(path, "must not contain itself");
    if (const std::size_t most = most_gltf_visits + document_.count("nodes"); ++visits_ > most)
      return document_.mistakes().add(path, "number of nodes below colliders must be at most " +
                                                std::to_string(most) +
                                                ", counted once per collider");
    const Json& json = document_.item("nodes", at.node);
    if (const auto index = document_.index(json, path, "mesh", "meshes")) {
      const GltfMeshUse use = gltf_mesh_use(document_, *index, at.node);
      const MeshParts& shown = mesh(use);
      const auto name_of = [](const Json& named) {
        const Json* name = named.find("name");
        return name && name->is_string() ? name->get<std::string>() : std::string();
      };
      // A skin's vertices keep their places, wherever its node is.
      const Affine<double> there = json.contains("skin") ? pose : at.pose;
      for (const Affine<double>& instance : gltf_instances(document_, at.node)) {
        shown_ += shown.vertices.size();
        if (has_too_many(shown_)) return;
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        for (const Vec3<double>& vertex : shown.vertices)
          all.vertices.push_back(there(instance(vertex)));
        const Mat3<double> linear = there.linear * instance.linear;
        const bool is_mirrored = linear.determinant() < 0;
        if (shown.attributes.any()) {
          MeshAttributes attributes = shown.attributes;
          map_normals(attributes, inverse_of(linear).transpose());
          if (is_mirrored) swap_corners(attributes);
          append(all.attributes, all.triangles.size(), attributes, shown.triangles.size(), 0);
        }
        for (std::array<std::uint32_t, 3> t : shown.triangles) {
          for (std::uint32_t& i : t) i += first;
          if (is_mirrored) std::swap(t[1], t[2]);
          all.triangles.push_back(t);
        }
        for (std::vector<std::uint32_t> part : shown.parts) {
          for (std::uint32_t& i : part) i += first;
          all.parts.push_back(std::move(part));
        }
        const Json& whole = document_.item("meshes", *index);
        for (const auto& [primitive, corners] : read(use).corners) {
          if (!looks || looks->parts.size() >= most_part_looks) continue;
          PartLook look{{name_of(json), name_of(whole)}, {}};
          if (const auto rgba =
                  looks_.colour_of(whole.at("primitives")[primitive],
                                   JsonPath() / "meshes" / *index / "primitives" / primitive))
            look.colours[*rgba] = corners;
          looks->parts.push_back(std::move(look));
        }
      }
    }
    for (const std::size_t child : gltf_children(document_, at.node))
      open.push_back({child, at.pose * gltf_pose(document_, child)});
  }
}

}  // namespace minkray
