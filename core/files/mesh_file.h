// SPDX-License-Identifier: MIT
// Reads the vertices of mesh files: Wavefront OBJ, and STL as text or binary. Only positions are
// used, for convex hulls; faces define parts and reveal truncated files, which are rejected. Not
// read by tinyobjloader, which takes a malformed coordinate for 0, 1e999 for infinity, and rounds
// 0.3 to another double than C++ does.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

struct MeshAttributes;

/// The faces of a mesh as triangles that hold each vertex of each face: a face of more corners is a
/// fan, one of fewer has its last corner again. In the file's order.
struct MeshTriangles {
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< the vertices' numbers, from 0 on
  /// The group of each triangle: of an OBJ the faces below an "o" or "g" with a name of its own, of
  /// an STL a solid.
  std::vector<std::uint32_t> groups;
};

/// All vertices, in the file's order and unit; at least one, each finite. If `triangles` are
/// wanted they are added there, and an OBJ's attributes to `attributes`, which still must be
/// settled. Throws std::runtime_error with the mistake in the file, without
/// its name: "line 12: ...".
std::vector<Vec3<double>> read_mesh_vertices(const std::filesystem::path& path,
                                             MeshTriangles* triangles = nullptr,
                                             MeshAttributes* attributes = nullptr);

enum class MeshFormat : unsigned char { obj, stl };

/// Reads a file's contents.
std::vector<Vec3<double>> mesh_vertices(std::string_view contents, MeshFormat format,
                                        MeshTriangles* triangles = nullptr,
                                        MeshAttributes* attributes = nullptr);

}  // namespace minkray
