// SPDX-License-Identifier: MIT
// Meshes and nodes of a glTF file: their vertices and transforms.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "core/files/mesh_parts.h"
#include "core/math/affine.h"
#include "renderer/import/mesh/gltf_document.h"
#include "renderer/import/mesh/gltf_looks.h"
#include "renderer/import/mesh/gltf_mesh_use.h"
#include "renderer/import/model/mesh_looks.h"

namespace minkray {

/// No file shows more vertices, meshes that are shown again counted again.
inline constexpr std::size_t most_gltf_vertices = 8'000'000;

/// Limit of visits to nodes below colliders, beyond the first visit to each: many colliders may
/// name the same node.
inline constexpr std::size_t most_gltf_visits = 100'000;

/// Turns y up to z up.
Affine<double> gltf_z_up();

class GltfMeshes {
 public:
  GltfMeshes(GltfDocument& document, MeshSplit split, MeshDetail detail)
      : document_(document), split_(split), detail_(detail), looks_(document) {}

  GltfLooks& looks() { return looks_; }

  /// The vertices that its triangles use, with one part a primitive (groups), one a connected
  /// piece (components), or none. Empty, and maybe mistakes, if there are none.
  const MeshParts& mesh(const GltfMeshUse& use);

  /// The primitive of each part of mesh(), if groups are requested.
  const std::vector<std::size_t>& primitives_of_parts(const GltfMeshUse& use);

  /// Number of primitives that were points or lines.
  std::size_t left_out() const { return left_out_; }

  /// Adds all meshes that are shown by nodes and those below them. `looks`, if any, get a part for
  /// each primitive.
  void add_shown(std::span<const std::size_t> nodes, const Affine<double>& pose, bool with_own_pose,
                 MeshParts& all, MeshLooks* looks = nullptr);

 private:
  struct Read {
    MeshParts parts;
    std::vector<std::size_t> primitives;
    std::vector<std::pair<std::size_t, std::size_t>> corners = {};  ///< by primitive that is shown
  };
  const Read& read(const GltfMeshUse& use);
  void add_primitive(const Json& primitive, const JsonPath& path, std::size_t number,
                     const std::vector<double>& weights, Read& read);
  bool add_targets(const Json& primitive, const JsonPath& path, const std::vector<double>& weights,
                   std::vector<Vec3<double>>& points);
  bool has_too_many(std::size_t vertices);

  GltfDocument& document_;
  MeshSplit split_;
  MeshDetail detail_;
  GltfLooks looks_;
  std::map<GltfMeshUse, Read> read_;
  std::size_t vertices_ = 0;  ///< of all meshes
  std::size_t shown_ = 0;     ///< by all requested nodes
  std::size_t visits_ = 0, left_out_ = 0;
};

/// The poses in which a node shows its mesh: several by EXT_mesh_gpu_instancing, else one.
std::vector<Affine<double>> gltf_instances(GltfDocument& document, std::size_t node);

/// Local pose of a node.
Affine<double> gltf_pose(GltfDocument& document, std::size_t node);

/// The nodes below a node.
std::vector<std::size_t> gltf_children(GltfDocument& document, std::size_t node);

/// The nodes without a parent that are shown: those of the file's scene, or all. A mistake if nodes
/// are no forest.
std::vector<std::size_t> gltf_roots(GltfDocument& document);

}  // namespace minkray
