// SPDX-License-Identifier: MIT
// Looks of a scene's meshes by instance. Scenes without looks hold nothing.
#pragma once

#include <memory>
#include <vector>

#include "core/world/world.h"
#include "renderer/scene/scene.h"
#include "renderer/surfaces/mesh_point.h"

namespace minkray {

/// A point of a surface: what was met, and its geometric normal.
struct SurfaceHit {
  std::uint32_t instance = no_instance, part = no_part;
  Vec3<double> normal = Vec3<double>::Zero();
};

inline SurfaceHit surface_hit(const WorldHit& hit) {
  return {hit.instance, hit.part, hit.cast.normal};
}

/// A point of a surface as it is shaded.
struct SmoothPoint {
  Vec3<double> normal;                       ///< in the world, on the side of the hit's
  Vec3<double> lift = Vec3<double>::Zero();  ///< from the triangle to the curved surface
  bool is_curved = false;  ///< light comes from all directions above the normal's plane
};

/// Shares the scene's meshes and attributes.
class LooksOfMeshes {
 public:
  explicit LooksOfMeshes(const Scene& scene);

  bool none() const { return looks_.empty(); }
  bool has_normals(std::uint32_t instance) const {
    const Look* look = of(instance);
    return look && !look->of->attributes->normal_of.empty();
  }
  /// Material of a mesh's triangle; `otherwise` where it has none of its own.
  std::uint32_t material(std::uint32_t instance, std::uint32_t part, std::uint32_t otherwise) const;
  /// Attributes at a point in the mesh's frame; none if the instance has no look.
  MeshPoint at(const SurfaceHit& hit, const Vec3<double>& point) const;
  /// Returns the interpolated normal (that of the hit for meshes without normals), and the curved
  /// surface if that normal is near the hit's.
  SmoothPoint smooth(const World& world, const SurfaceHit& hit, const Vec3<double>& point,
                     double time) const;

 private:
  struct Look {
    std::shared_ptr<const TriangleMesh> mesh;
    std::shared_ptr<const MeshLook> of;  ///< null: no look
    Affine<double> to_mesh;
  };
  const Look* of(std::uint32_t instance) const {
    return instance < looks_.size() && looks_[instance].of ? &looks_[instance] : nullptr;
  }

  std::vector<Look> looks_;  ///< by object, up to the last that has one
};

}  // namespace minkray
