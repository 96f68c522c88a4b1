// SPDX-License-Identifier: MIT
// The light that arrives along a ray: direct light with shadows, mirrored light, and light
// scattered by surfaces that the environment and other surfaces shine on, with ambient occlusion as
// the last word.
#pragma once

#include <cstdint>
#include <span>
#include <vector>
#include "renderer/light/integrator_options.h"

#include "renderer/light/light_transport.h"
#include "renderer/light/lights.h"
#include "renderer/light/reflection.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Refers to the scene's world; keeps everything else itself.
class AmbientTransport final : public LightTransport {
 public:
  AmbientTransport(const Scene& scene, const RenderWorld& world, const IntegratorOptions& options);

  void trace(std::span<TracedRay> rays, RayCounts& counts) const override;

 private:
  struct Path;
  struct HitPoint;
  template <std::size_t most>
  void follow(std::span<TracedRay> rays, const Path& path, RayCounts& counts) const;
  Colour behind(const HitPoint& point, const Vec3<double>& direction, const Path& path,
                Sampler& sampler, RayCounts& counts) const;
  Colour off_surface(const Ray<Real>& ray, const WorldHit<Real>& hit, const Path& path,
                     RayCounts& counts) const;
  HitPoint hit_point(const TracedRay& ray, const WorldHit<Real>& hit) const;
  template <std::size_t most>
  void add_direct(std::span<TracedRay> rays, std::span<const std::optional<HitPoint>> points,
                  const Path& path, RayCounts& counts) const;
  Colour indirect(const HitPoint& point, const Colour& direct, const Path& path, Sampler& sampler,
                  RayCounts& counts) const;
  Colour scattered(const HitPoint& point, const Path& path, Sampler& sampler,
                   RayCounts& counts) const;
  Colour mirrored(const HitPoint& point, const Coat& coat, const Path& path, Sampler& sampler,
                  RayCounts& counts) const;
  RayGroupMask blocked(RayKind kind, std::span<const WorldRay<Real>> rays, RayCounts& counts) const;

  const RenderWorld& world_;
  IntegratorOptions options_;
  std::vector<Surface> surfaces_;
  std::vector<std::uint32_t> surface_of_instance_;
  std::vector<Colour> radiance_;  ///< by surface: what it shines
  Lights lights_;
  EnvironmentSource background_;
};

}  // namespace minkray
