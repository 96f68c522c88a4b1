// SPDX-License-Identifier: MIT
// The parts of a mesh, so that each can have a hull of its own: as the file groups them, or as
// they hang together.
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

/// Amount of a mesh file to read, each with all before it.
enum class MeshDetail : unsigned char { vertices, triangles, attributes };

/// Vertices, and the end of each part that the file distinguishes: at least one.
struct MeshParts {
  std::vector<Vec3<double>> vertices;
  std::vector<std::vector<std::uint32_t>> parts = {};  ///< vertices of each; empty: all are one
  std::vector<std::array<std::uint32_t, 3>> triangles = {};  ///< of all parts, if requested
  MeshAttributes attributes = {};  ///< settled, of the triangles, if requested
};

/// Reads OBJ and STL as read_mesh_vertices() does. Groups are what follows an "o" or "g" with
/// another name, and STL's solids. Each vertex that a face names is in a part; of a file without
/// faces all are one. Throws std::runtime_error without the file's name.
MeshParts read_mesh_parts(const std::filesystem::path& file, MeshSplit split,
                          MeshDetail detail = MeshDetail::vertices);

/// Reads a file's contents.
MeshParts mesh_parts(std::string_view contents, MeshFormat format, MeshSplit split);

/// The vertices of each connected part, parts in the order of their first triangle. Vertices at the
/// same place are one. Vertices of no triangle are left out.
std::vector<std::vector<std::uint32_t>> components_of(
    std::span<const Vec3<double>> vertices,
    std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace minkray
