// SPDX-License-Identifier: MIT
// Looks of a glTF file's primitives: base colours and their textures, normals and texture
// coordinates.
#pragma once

#include <span>
#include <vector>

#include "core/files/mesh_attributes.h"
#include "renderer/import/mesh/gltf_document.h"
#include "renderer/import/model/mesh_looks.h"

namespace minkray {

/// A material as far as it is read: its base colour, and where its picture lies.
struct GltfLook {
  MeshMaterial material;
  std::size_t uv_set = 0;  ///< TEXCOORD_n
  /// KHR_texture_transform: from the coordinates to the picture.
  std::array<double, 2> offset = {0, 0}, scale = {1, 1};
  double rotation = 0;  ///< in radians, counter-clockwise
};

/// Limit of triangles with colours at their vertices: each takes 100 to 150 bytes more.
inline constexpr std::size_t most_triangles_of_colours = std::size_t{1} << 22;

class GltfLooks {
 public:
  explicit GltfLooks(GltfDocument& document) : document_(document) {}

  /// All materials of the file, by their numbers; read once.
  const std::vector<GltfLook>& all();
  /// The materials of all(), and behind them those of primitives whose vertices have colours: these
  /// are added as primitives are read.
  std::vector<MeshMaterial> materials();

  /// Number of primitives whose vertices' colours are left out, by the reason.
  const std::map<std::string, std::size_t>& colours_left_out() const { return colours_left_out_; }

  /// One colour for a primitive: its material's times the mean of its vertices'. Nothing if it has
  /// neither.
  std::optional<Rgba> colour_of(const Json& primitive, const JsonPath& path);

  /// Attributes of a primitive's triangles, which are numbers into `used`; those are numbers of its
  /// `count` points. Mistakes where accessors are wrong.
  MeshAttributes attributes_of(const Json& primitive, const JsonPath& path, std::size_t count,
                               std::span<const std::uint32_t> used,
                               std::span<const MeshAttributes::Numbers> triangles);

 private:
  GltfLook look_of(std::size_t material);
  void add_colours(const Json& primitive, const JsonPath& path, std::size_t count,
                   std::span<const std::uint32_t> used,
                   const std::vector<MeshAttributes::Numbers>& triangles, const GltfLook& look,
                   MeshAttributes& made);
  void read_picture(const Json& texture_info, const JsonPath& path, GltfLook& look);

  GltfDocument& document_;
  bool is_read_ = false;
  std::vector<GltfLook> all_;
  std::vector<MeshMaterial> of_colours_;
  std::map<std::size_t, Vec3<double>> means_;  ///< of accessors of colours
  std::size_t triangles_of_colours_ = 0;
  std::map<std::string, std::size_t> colours_left_out_;
  std::map<std::size_t, std::shared_ptr<const std::string>> bytes_;  ///< of pictures in the file
};

}  // namespace minkray
