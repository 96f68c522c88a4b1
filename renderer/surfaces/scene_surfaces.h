// SPDX-License-Identifier: MIT
// Material of each instance, prepared for the path tracer.
#pragma once

#include <memory>
#include <vector>

#include "core/world/world.h"
#include "renderer/scene/scene.h"
#include "renderer/surfaces/bsdf.h"
#include "renderer/surfaces/looks_of_meshes.h"

namespace minkray {

/// The inside of a clear body.
struct Medium {
  double eta = 1;
  Colour absorption = Colour::Zero();
  double priority = 0;
};

/// Index of each instance's material.
std::vector<std::uint32_t> material_of_instance(const Scene& scene);

/// Radiance that a material emits; zero if none.
Colour radiance_of(const Scene& scene, const Material& material);

struct PreparedMaterial {
  std::unique_ptr<const Bsdf> bsdf;
  Paint colour = Colour::Zero();
  Colour radiance;
  Medium inside;
  Relief relief;
  bool is_sheet = false;  ///< transmitted light is on the other side, not within
};

class SceneSurfaces {
 public:
  explicit SceneSurfaces(const Scene& scene);

  /// `part` is the triangle of a mesh, which may have several materials.
  const PreparedMaterial& of(std::uint32_t instance, std::uint32_t part = no_part) const {
    const std::uint32_t own = of_instance_[instance];
    return materials_[part == no_part ? own : looks_.material(instance, part, own)];
  }
  /// The place in the object's frame; for particles it is not turned. The footprint is what a cone
  /// around a ray of that direction lights of the plane that touches the surface. Its normal is the
  /// mesh's interpolated one, if it has one, on the side of `normal`.
  TexturePoint place(const World& world, const SurfaceHit& hit, const Vec3<double>& point,
                     double time, const Vec3<double>& direction, const RayCone& cone) const;
  const LooksOfMeshes& looks() const { return looks_; }
  /// The colour of what a ray has met, and what it shines; nothing is changed where it met nothing.
  void describe(const World& world, const Ray<double>& ray, const RayCone& cone,
                const WorldHit& hit, Colour& albedo, Colour& emission) const;
  /// Longitude and latitude around the origin of the object that a ray has met, as the mapping
  /// radial has them; zero where it met nothing.
  Vec3<double> uv(const World& world, const Ray<double>& ray, const WorldHit& hit) const;
  /// The normal of the instance's relief in the world, where the place in the object's frame is
  /// given.
  Vec3<double> relief_normal_at(std::uint32_t instance, const TexturePoint& at) const;
  bool has_sheets() const { return has_sheets_; }
  /// True if any colour or relief varies over a surface.
  bool has_textures() const { return has_textures_; }
  /// The direction of the object's z axis, around which brushed metal has its grain.
  Vec3<double> axis(std::uint32_t instance) const {
    return instance < axes_.size() ? axes_[instance] : Vec3<double>(Vec3<double>::UnitZ());
  }
  /// True if any material emits light.
  bool has_lamps() const;
  /// Radiance of each instance.
  std::vector<Colour> radiances() const;

 private:
  std::vector<PreparedMaterial> materials_;
  std::vector<std::uint32_t> of_instance_;
  LooksOfMeshes looks_;
  std::vector<Affine<double>> to_object_;  ///< of objects
  bool has_textures_ = false, has_sheets_ = false;
  std::vector<Vec3<double>> axes_;  ///< of objects; particles have the world's
};

}  // namespace minkray
