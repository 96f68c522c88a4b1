// SPDX-License-Identifier: MIT
// Splits the faces of a mesh file, which are given corner by corner, into triangles.
#pragma once

#include "core/files/mesh_attributes.h"
#include "core/files/mesh_file.h"
#include "core/files/text.h"

namespace minkray {

inline std::string place_of_line(std::size_t number) {
  return "line " + std::to_string(number) + ": ";
}

/// Returns the three coordinates at the front of the line.
inline Vec3<double> coordinates(std::string_view line, std::size_t line_number) {
  Vec3<double> vertex;
  for (double& coordinate : vertex) {
    if (!read_number(bare_number(next_word(line)), coordinate) || !std::isfinite(coordinate)) {
      throw std::runtime_error(place_of_line(line_number) +
                               "a vertex must be three finite numbers");
    }
  }
  return vertex;
}

/// Numbers of a corner's vertex, texture coordinates and normal.
struct FaceCorner {
  std::uint32_t vertex = 0, uv = MeshAttributes::none, normal = MeshAttributes::none;
};

/// Adds triangles, and their attributes, to the given lists. A null list is not filled.
class TriangleFans {
 public:
  TriangleFans(MeshTriangles* triangles, MeshAttributes* attributes)
      : triangles_(triangles), attributes_(attributes) {}

  bool are_wanted() const { return triangles_ != nullptr; }
  MeshAttributes* attributes() const { return attributes_; }

  /// Puts the following faces into this group.
  void begin_group(std::uint32_t group) { group_ = group; }
  /// Gives the following faces this material.
  void begin_material(std::uint32_t material) { material_ = material; }

  void add_corner(const FaceCorner& corner) {
    if (count_ == 0) first_ = corner;
    if (count_ >= 2) add_triangle(corner);
    last_ = corner;
    ++count_;
  }

  void end_face() {
    if (count_ == 1 || count_ == 2) add_triangle(last_);
    count_ = 0;
  }

 private:
  void add_triangle(const FaceCorner& corner) {
    if (!are_wanted()) return;
    triangles_->corners.push_back({first_.vertex, last_.vertex, corner.vertex});
    triangles_->groups.push_back(group_);
    if (!attributes_) return;
    attributes_->uv_of.push_back({first_.uv, last_.uv, corner.uv});
    attributes_->normal_of.push_back({first_.normal, last_.normal, corner.normal});
    attributes_->material_of.push_back(material_);
  }

  MeshTriangles* triangles_;
  MeshAttributes* attributes_;
  std::uint32_t group_ = 0, material_ = MeshAttributes::none;
  std::size_t count_ = 0;  ///< corners of the face so far
  FaceCorner first_, last_;
};

}  // namespace minkray
