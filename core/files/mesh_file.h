// SPDX-License-Identifier: MIT
// The vertices of mesh files: Wavefront OBJ, and STL as text or binary. Only positions matter, for
// their convex hull is all that is wanted; but files that are cut off are refused where that shows:
// at faces without vertices, solids without an end, and fewer bytes than the triangles need.
// Read here rather than by tinyobjloader, which takes a malformed coordinate for 0, 1e999 for
// infinity, and rounds 0.3 to another double than C++ does.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

/// All vertices, in the file's order and unit; at least one, each finite. Throws std::runtime_error
/// that says what is wrong with the file, without its name: "line 12: ...".
std::vector<Vec3<double>> read_mesh_vertices(const std::filesystem::path& path);

enum class MeshFormat : unsigned char { obj, stl };

/// Reads a file's contents.
std::vector<Vec3<double>> mesh_vertices(std::string_view contents, MeshFormat format);

}  // namespace minkray
