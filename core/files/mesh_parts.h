// SPDX-License-Identifier: MIT
// Splits a mesh into parts, so that each can have its own hull: by the file's groups, or by
// connected components.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "core/files/mesh_attributes.h"
#include "core/files/mesh_file.h"
#include "core/math/vec.h"

namespace minkray {

enum class MeshSplit : unsigned char { none, groups, components };

/// Amount of a mesh file to read; each value includes the previous ones.
enum class MeshDetail : unsigned char { vertices, triangles, attributes };

/// Vertices of a mesh file (at least one), and its parts.
struct MeshParts {
  std::vector<Vec3<double>> vertices;
  std::vector<std::vector<std::uint32_t>> parts = {};  ///< vertices by part; empty: a single part
  std::vector<std::array<std::uint32_t, 3>> triangles = {};  ///< of all parts, if requested
  MeshAttributes attributes = {};  ///< of the triangles, after settle(), if requested
};

/// Reads an OBJ or STL file, as read_mesh_vertices() does, and splits its mesh into parts. A group
/// is everything below an "o" or "g" line with another name, or a solid of an STL file. Each vertex
/// that a face uses is in a part. A file without faces is a single part. Throws std::runtime_error
/// without the file's name.
MeshParts read_mesh_parts(const std::filesystem::path& file, MeshSplit split,
                          MeshDetail detail = MeshDetail::vertices);

/// Same for a file's contents.
MeshParts mesh_parts(std::string_view contents, MeshFormat format, MeshSplit split);

/// Returns the vertices of each connected part, in the order of the parts' first triangles.
/// Vertices at the same position count as one. Omits vertices that no triangle uses.
std::vector<std::vector<std::uint32_t>> components_of(
    std::span<const Vec3<double>> vertices,
    std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace minkray
