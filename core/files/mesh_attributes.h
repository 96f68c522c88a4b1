// SPDX-License-Identifier: MIT
// Attributes of a mesh's triangles that only pictures need: normals, texture coordinates and
// materials. Normals and coordinates have their own indices, so vertices can be merged freely.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

struct MeshAttributes {
  using Numbers = std::array<std::uint32_t, 3>;
  /// Marks a missing normal, coordinate or material.
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  static constexpr Numbers no_numbers = {none, none, none};

  std::vector<Vec3<float>> normals;  ///< of unit length; zero: unusable
  /// Texture coordinates; v goes from the top down, as the rows of pictures.
  std::vector<std::array<float, 2>> uvs;
  /// For each triangle, the numbers of its corners' normals and coordinates; empty if no triangle
  /// has any.
  std::vector<Numbers> normal_of, uv_of;
  std::vector<std::uint32_t> material_of;  ///< by triangle; empty if no triangle has a material
  std::vector<std::string> materials;      ///< names of an OBJ file's materials, by number
  std::vector<std::string> libraries;      ///< material files that an OBJ file names
  /// Counts of triangles whose normals or coordinates were invalid and are omitted.
  std::size_t bad_normals = 0, bad_uvs = 0;

  bool any() const { return !normal_of.empty() || !uv_of.empty() || !material_of.empty(); }
};

/// Returns the vector scaled to unit length; zero if the vector is zero or not finite.
Vec3<float> attribute_normal(const Vec3<double>& normal);

/// Omits and counts attributes with numbers out of range, zero normals or coordinates that are not
/// finite. Lists without valid items become empty.
void settle(MeshAttributes& attributes);

/// Attributes of some triangles, by their numbers, without attributes that no triangle uses.
MeshAttributes attributes_of(const MeshAttributes& all, std::span<const std::uint32_t> triangles);

/// Appends the attributes of `count` triangles to those of `before` triangles. Adds
/// `first_material` to the appended material numbers.
void append(MeshAttributes& all, std::size_t before, const MeshAttributes& more, std::size_t count,
            std::uint32_t first_material);

/// Maps normals by the inverse transpose of a linear map. If the map mirrors, the caller must also
/// call swap_corners(), which swaps two corners of each triangle, and do the same to the mesh's own
/// triangles.
void map_normals(MeshAttributes& attributes, const Mat3<double>& inverse_transpose);
void swap_corners(MeshAttributes& attributes);

/// Describes omitted attributes; empty if there are none.
std::vector<std::string> notes_of(const MeshAttributes& attributes);

/// Returns the mean normals of the triangles around each vertex, weighted by their angles at the
/// vertex. Triangles that meet at an angle of more than `crease` radians do not share normals.
MeshAttributes smooth_normals(std::span<const Vec3<double>> vertices,
                              std::span<const std::array<std::uint32_t, 3>> triangles,
                              double crease);

}  // namespace minkray
