// SPDX-License-Identifier: MIT
#include "core/files/mesh_parts.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace minkray {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using Parts = std::vector<std::vector<std::uint32_t>>;

Parts parts_by(std::span<const std::uint32_t> label_of_triangle,
               std::span<const Corners> triangles) {
  std::map<std::uint32_t, std::size_t> place;
  Parts parts;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto [at, is_new] = place.emplace(label_of_triangle[i], parts.size());
    if (is_new) parts.emplace_back();
    parts[at->second].insert(parts[at->second].end(), triangles[i].begin(), triangles[i].end());
  }
  for (std::vector<std::uint32_t>& part : parts) {
    std::ranges::sort(part);
    part.erase(std::unique(part.begin(), part.end()), part.end());
  }
  return parts;
}

/// Reads a mesh by `read` and splits it.
template <class Read>
MeshParts split_by(MeshSplit split, MeshDetail detail, const Read& read) {
  if (split == MeshSplit::none && detail == MeshDetail::vertices) return {read(nullptr, nullptr)};
  MeshTriangles triangles;
  MeshAttributes attributes;
  MeshParts mesh{read(&triangles, detail == MeshDetail::attributes ? &attributes : nullptr)};
  if (split == MeshSplit::groups) mesh.parts = parts_by(triangles.groups, triangles.corners);
  if (split == MeshSplit::components) mesh.parts = components_of(mesh.vertices, triangles.corners);
  if (detail != MeshDetail::vertices) mesh.triangles = std::move(triangles.corners);
  settle(attributes);
  mesh.attributes = std::move(attributes);
  return mesh;
}

}  // namespace

Parts components_of(std::span<const Vec3<double>> vertices, std::span<const Corners> triangles) {
  // Merges vertices at the same place.
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    return std::array{vertices[i].x(), vertices[i].y(), vertices[i].z()};
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> root(vertices.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a != b) root[std::max(a, b)] = std::min(a, b);
  };
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i - 1]) == key(order[i])) join(order[i - 1], order[i]);
  for (const Corners& triangle : triangles) {
    join(triangle[0], triangle[1]);
    join(triangle[1], triangle[2]);
  }
  std::vector<std::uint32_t> labels;
  labels.reserve(triangles.size());
  for (const Corners& triangle : triangles) labels.push_back(find(triangle[0]));
  return parts_by(labels, triangles);
}

MeshParts read_mesh_parts(const std::filesystem::path& file, MeshSplit split, MeshDetail detail) {
  return split_by(split, detail, [&](MeshTriangles* triangles, MeshAttributes* attributes) {
    return read_mesh_vertices(file, triangles, attributes);
  });
}

MeshParts mesh_parts(std::string_view contents, MeshFormat format, MeshSplit split) {
  return split_by(split, MeshDetail::vertices,
                  [&](MeshTriangles* triangles, MeshAttributes* attributes) {
                    return mesh_vertices(contents, format, triangles, attributes);
                  });
}

}  // namespace minkray
