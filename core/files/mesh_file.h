// SPDX-License-Identifier: MIT
// Reads the vertices of mesh files: Wavefront OBJ, and STL as text or binary. Convex hulls use only
// positions; faces define parts and reveal truncated files, which are rejected. Does not use
// tinyobjloader, which reads a malformed coordinate as 0 and 1e999 as infinity, and rounds 0.3 to a
// different double than C++.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

struct MeshAttributes;

/// The faces of a mesh as triangles, in the file's order. A face with more than three corners
/// becomes a fan; a face with fewer repeats its last corner.
struct MeshTriangles {
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< the vertices' numbers, from 0 on
  /// The group of each triangle. A group of an OBJ file is the faces below an "o" or "g" line with
  /// a new name. A group of an STL file is a solid.
  std::vector<std::uint32_t> groups;
};

/// Returns all vertices, in the file's order and unit. There is at least one, and all are finite.
/// Writes the triangles to `triangles` if not null. Writes the attributes of an OBJ file to
/// `attributes` if not null; the caller must then call settle(). Throws std::runtime_error that
/// describes the error in the file, without the file's name: "line 12: ...".
std::vector<Vec3<double>> read_mesh_vertices(const std::filesystem::path& path,
                                             MeshTriangles* triangles = nullptr,
                                             MeshAttributes* attributes = nullptr);

enum class MeshFormat : unsigned char { obj, stl };

/// Same for a file's contents.
std::vector<Vec3<double>> mesh_vertices(std::string_view contents, MeshFormat format,
                                        MeshTriangles* triangles = nullptr,
                                        MeshAttributes* attributes = nullptr);

}  // namespace minkray
