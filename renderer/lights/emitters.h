// SPDX-License-Identifier: MIT
// Samples emissive bodies. For shapes, directions are drawn towards the ellipsoid around the body
// (uniformly in the cone of a unit ball, exact for balls, ellipsoids and disks) or a face of its
// box, whichever looks smaller. The map A from the world to that frame changes solid angles by |det
// A| / |A d|^3 for unit d. A cast decides if a direction meets the body. Meshes are sampled by
// triangle (mesh_lamp.h).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/world/world.h"
#include "renderer/lights/light_tree.h"
#include "renderer/lights/mesh_lamp.h"
#include "renderer/rays/sampler.h"
#include "renderer/scene/materials.h"

namespace minkray {

/// An ellipsoid about a body, |map (x - centre)| <= 1, or its box, |map (x - centre)| <=
/// half_extents. Points outside of the ellipsoid are not drawn.
struct AroundBody {
  Vec3<double> centre;
  Mat3<double> map, inverse;
  Vec3<double> half_extents = Vec3<double>::Zero();  ///< zero: an ellipsoid
  double determinant;                                ///< of the map, positive
  double size2;                                      ///< about its shadow's area over pi

  bool is_box() const { return !half_extents.isZero(0); }
  /// A direction of unit length from the point; nothing from within.
  std::optional<Vec3<double>> sample(const Vec3<double>& point,
                                     const std::array<double, 2>& u) const;
  /// The density over solid angle; 0 from within, and of directions that are not drawn.
  double pdf(const Vec3<double>& point, const Vec3<double>& direction) const;
};

/// The least of those that are known about an instance of a world.
AroundBody around(const PreparedShape& body);

/// A direction towards an emitter.
struct EmitterSample {
  std::size_t emitter;
  Vec3<double> direction;
  double pdf;                    ///< over solid angle, with the chance of this emitter
  std::uint32_t part = no_part;  ///< of a mesh: the triangle that must be met
};

/// A place on an emitter: of a mesh the triangle, and its distance.
struct EmitterHit {
  std::uint32_t instance, part = no_part;
  double t = 0;
};

/// The instances of a world that shine.
class Emitters {
 public:
  /// Radiance of a triangle of a mesh, by instance and part.
  using RadianceOfPart = std::function<Colour(std::uint32_t, std::uint32_t)>;

  /// Takes the radiance of each instance, zero for none, and of triangles if any material shines.
  /// Refers to the world.
  Emitters(const World& world, const std::vector<Colour>& radiance_of_instance,
           const RadianceOfPart& radiance_of_part);

  bool none() const { return emitters_.empty(); }
  std::uint32_t instance(std::size_t emitter) const { return emitters_[emitter].instance; }
  /// Radiance of a shape; meshes have one for each part.
  const Colour& radiance(std::size_t emitter) const { return emitters_[emitter].radiance; }

  /// Places of the emitters at that time, while the shutter is open.
  std::optional<EmitterSample> sample(const Vec3<double>& point, double time,
                                      Sampler& sampler) const;
  /// The density with which `sample` draws a direction that meets the instance there.
  double pdf(const Vec3<double>& point, double time, const Vec3<double>& direction,
             const EmitterHit& hit) const;

 private:
  struct Emitter {
    std::uint32_t instance;
    Colour radiance;
    AroundBody body;
    double power;                          ///< brightness times size
    std::unique_ptr<const MeshLamp> mesh;  ///< null: a shape
  };

  void add_mesh(std::uint32_t instance, const RadianceOfPart& radiance_of_part,
                std::vector<LightTree::Light>& lights);
  void number_last(std::size_t instances);

  Vec3<double> seen_from(const Emitter& emitter, const Vec3<double>& point, double time) const;
  /// In proportion to the chance to draw it, as long as there are few.
  double weight(const Emitter& emitter, const Vec3<double>& point, double time) const;

  const World& world_;
  std::vector<Emitter> emitters_;           ///< in the order of their instances
  std::vector<std::uint32_t> of_instance_;  ///< an index into them, or none
  LightTree tree_;                          ///< of them, if they are many
};

}  // namespace minkray
