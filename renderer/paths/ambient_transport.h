// SPDX-License-Identifier: MIT
// Direct light with shadows, mirrored light, and ambient occlusion: light from the environment and
// other surfaces, scattered by the surface that a ray hits.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/lights/lights.h"
#include "renderer/paths/light_transport.h"
#include "renderer/paths/wave_casts.h"
#include "renderer/scene/scene.h"
#include "renderer/surfaces/looks_of_meshes.h"
#include "renderer/surfaces/reflection.h"

namespace minkray {

/// Refers to the scene's world; keeps everything else itself.
class AmbientTransport final : public LightTransport {
 public:
  AmbientTransport(const Scene& scene, const World& world, const IntegratorOptions& options);

  void trace(std::span<TracedRay> rays, RayCounts& counts) const override;

 private:
  struct Path;
  struct HitPoint;
  struct Wave;
  /// Hit point of each ray, if any.
  using HitPoints = std::vector<std::optional<HitPoint>>;

  void follow(std::span<TracedRay> rays, const Path& path, RayCounts& counts) const;
  Colour off_surface(const Ray<double>& ray, const WorldHit& hit, const Path& path,
                     RayCounts& counts) const;
  std::uint32_t surface_of(const WorldHit& hit) const {
    const std::uint32_t own = surface_of_instance_[hit.instance];
    return looks_.none() ? own : looks_.material(hit.instance, hit.part, own);
  }
  HitPoint hit_point(const TracedRay& ray, const WorldHit& hit) const;
  void add_direct(std::span<TracedRay> rays, const HitPoints& points, const Path& path,
                  RayCounts& counts) const;
  void add_indirect(std::span<TracedRay> rays, const HitPoints& points, const Path& path,
                    RayCounts& counts) const;
  /// Adds light scattered by the bases of some rays' surfaces; `chances` are the probabilities of
  /// having come here.
  void add_scattered(std::span<TracedRay> rays, const HitPoints& points,
                     std::span<const std::size_t> which, std::span<const double> chances,
                     const Path& path, RayCounts& counts) const;
  /// Adds light mirrored by their coats.
  void add_mirrored(std::span<TracedRay> rays, const HitPoints& points,
                    std::span<const std::size_t> which, std::span<const double> chances,
                    const Path& path, RayCounts& counts) const;
  static TracedRay behind(const HitPoint& point, const Vec3<double>& direction,
                          const Sampler& sampler);
  static void take_back(const Wave& wave, std::span<TracedRay> rays,
                        std::span<const double> chances);

  const World& world_;
  WaveCasts casts_;
  IntegratorOptions options_;
  std::vector<Surface> surfaces_;
  std::vector<std::uint32_t> surface_of_instance_;
  LooksOfMeshes looks_;
  std::vector<Colour> radiance_;  ///< by surface: what it shines
  Lights lights_;
  EnvironmentSource background_;
};

}  // namespace minkray
