// SPDX-License-Identifier: MIT
#include "core/files/mesh_parts.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <numeric>
#include <stdexcept>

#include "core/files/mesh_file.h"
#include "core/files/regular_file.h"

namespace minkray {
namespace {

constexpr std::size_t most_mesh_bytes = std::size_t{512} << 20;

using Corners = std::array<std::uint32_t, 3>;
using Parts = std::vector<std::vector<std::uint32_t>>;

/// Triangles, each with the number of its group.
struct Grouped {
  std::vector<Corners> triangles;
  std::vector<std::uint32_t> group_of;
};

std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
  line.remove_prefix(word.size());
  return word;
}

std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

/// The file was read already: what its faces name is there.
Grouped faces_of_obj(std::string_view text, std::size_t count) {
  Grouped grouped;
  std::map<std::pair<std::string, std::string>, std::uint32_t> groups;
  std::string object, group;
  std::uint32_t current = 0;
  std::size_t above = 0;
  while (!text.empty()) {
    std::string_view line = take_line(text);
    line = line.substr(0, line.find('#'));
    const std::string_view word = take_word(line);
    if (word == "v") ++above;
    if (word == "o" || word == "g") {
      (word == "o" ? object : group) = std::string(take_word(line));
      if (word == "o") group.clear();
      const auto next = static_cast<std::uint32_t>(groups.size());
      current = groups.emplace(std::pair(object, group), next).first->second;
    }
    if (word != "f") continue;
    std::vector<std::uint32_t> corners;
    for (std::string_view corner = take_word(line); !corner.empty(); corner = take_word(line)) {
      long long index = 0;
      std::from_chars(corner.data(), corner.data() + corner.size(), index);
      const long long at = index < 0 ? static_cast<long long>(above) + index : index - 1;
      if (at >= 0 && static_cast<std::size_t>(at) < count)
        corners.push_back(static_cast<std::uint32_t>(at));
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
      grouped.triangles.push_back({corners[0], corners[i - 1], corners[i]});
      grouped.group_of.push_back(current);
    }
  }
  return grouped;
}

/// Each three vertices are a facet. Of text the facets of a solid stand between its lines.
Grouped facets_of_stl(std::string_view text, std::size_t count) {
  Grouped grouped;
  for (std::uint32_t i = 0; i + 2 < count; i += 3) {
    grouped.triangles.push_back({i, i + 1, i + 2});
    grouped.group_of.push_back(0);
  }
  std::size_t facet = 0;
  std::uint32_t solids = 0;
  while (!text.empty()) {
    std::string_view line = take_line(text);
    const std::string_view word = take_word(line);
    if (word == "endsolid") ++solids;
    if (word == "facet" && facet < grouped.group_of.size()) grouped.group_of[facet++] = solids;
  }
  return grouped;
}

Parts parts_by(const std::vector<std::uint32_t>& label_of_triangle,
               const std::vector<Corners>& triangles) {
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

}  // namespace

Parts components_of(std::span<const Vec3<double>> vertices, std::span<const Corners> triangles) {
  // Vertices at one place become one.
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
  return parts_by(labels, {triangles.begin(), triangles.end()});
}

MeshParts read_mesh_parts(const std::filesystem::path& file, MeshSplit split) {
  MeshParts mesh{read_mesh_vertices(file)};
  if (split == MeshSplit::none) return mesh;
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const bool is_obj = ending == ".obj";
  const std::string text = read_regular_file(file, most_mesh_bytes);
  const Grouped grouped =
      is_obj ? faces_of_obj(text, mesh.vertices.size()) : facets_of_stl(text, mesh.vertices.size());
  mesh.parts = split == MeshSplit::groups ? parts_by(grouped.group_of, grouped.triangles)
                                          : components_of(mesh.vertices, grouped.triangles);
  return mesh;
}

}  // namespace minkray
