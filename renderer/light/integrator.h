// SPDX-License-Identifier: MIT
// The light that arrives along a ray: direct light with shadows, mirrored light, and light
// scattered by surfaces that the environment and other surfaces shine on.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/audit/ray_audit.h"
#include "renderer/base/real.h"
#include "renderer/light/reflection.h"
#include "renderer/light/sampler.h"
#include "renderer/scene/scene.h"

namespace minkray {

struct RayCounts {
  std::uint64_t camera = 0;
  std::uint64_t shadow = 0;     ///< towards directional and point lights
  std::uint64_t ambient = 0;    ///< the last of a path, towards the environment: any hit will do
  std::uint64_t scattered = 0;  ///< from a diffuse surface to the next one
  std::uint64_t mirrored = 0;
  std::uint64_t background = 0;   ///< camera rays that met nothing
  std::uint64_t from_inside = 0;  ///< camera rays that began in a shape, and see black
  QueryCounts work;

  std::uint64_t total() const { return camera + shadow + ambient + scattered + mirrored; }
  RayCounts& operator+=(const RayCounts& other);
};

struct IntegratorOptions {
  /// How often light may be scattered between surfaces before the environment's light is the last
  /// word; 0 is ambient occlusion.
  int bounces = 1;
  /// How many mirrors in a row are followed; behind the last, the environment is seen.
  int mirrors = 4;
  /// How many camera rays are traced together, with the shadow rays of what they meet; 1: each by
  /// itself. The picture is the same bit for bit.
  int packet = 16;
  /// Told of every ray and its answer, if it is there.
  RayAudit* audit = nullptr;
};

/// A camera ray and where its light comes to.
struct CameraRay {
  Ray<Real> ray;  ///< of unit direction
  Sampler sampler;
  Colour radiance;
  bool met;       ///< whether it met an object
  Real time = 0;  ///< while the shutter is open: from 0 to 1
};

/// No more camera rays can be traced together.
inline constexpr int most_in_packet = most_rays_at_once;

/// Refers to the scene's world; keeps everything else itself. Any number of threads may ask.
class Integrator {
 public:
  Integrator(const Scene& scene, const RenderWorld& world, const IntegratorOptions& options = {});

  /// Fills in what camera rays see, at most most_in_packet at once. What a ray sees does not depend
  /// on the others. Instances of the scene and of the world share their indices.
  void trace(std::span<CameraRay> rays, RayCounts& counts) const;

  /// Radiance along a single camera ray, at a time from 0 to 1 while the shutter is open.
  Colour radiance(const Ray<Real>& ray, Sampler& sampler, RayCounts& counts, Real time = 0) const;

 private:
  struct Path;
  struct Spot;
  struct ShadowRay;
  Colour along(const Ray<Real>& ray, const Path& path, Sampler& sampler, RayCounts& counts) const;
  Colour off_surface(const Ray<Real>& ray, const WorldHit<Real>& hit, const Path& path,
                     RayCounts& counts) const;
  Spot spot_of(const Ray<Real>& ray, const WorldHit<Real>& hit, Real time) const;
  Colour from_spot(const Spot& spot, const Colour& arrived, const Path& path, Sampler& sampler,
                   RayCounts& counts) const;
  std::optional<ShadowRay> shadow_ray(std::size_t light, const Spot& spot) const;
  Colour unblocked(const ShadowRay& from_light, const Spot& spot, const Path& path) const;
  Colour direct(const Spot& spot, const Path& path, RayCounts& counts) const;
  void direct(std::span<const std::optional<Spot>> spots, const Path& path,
              std::span<Colour> arrived, RayCounts& counts) const;
  Colour scattered(const Spot& spot, const Path& path, Sampler& sampler, RayCounts& counts) const;
  Colour mirrored(const Spot& spot, const Path& path, Sampler& sampler, RayCounts& counts) const;
  Colour environment(const Vec3<double>& direction) const;
  bool occluded(RayKind kind, const Ray<Real>& ray, const Spot& from, RayCounts& counts) const;
  std::size_t light_count() const { return directional_.size() + points_.size(); }

  const RenderWorld& world_;
  IntegratorOptions options_;
  std::vector<Surface> surfaces_;
  std::vector<std::uint32_t> surface_of_instance_;
  std::vector<DirectionalLight> directional_;
  std::vector<PointLight> points_;
  std::vector<EnvironmentLight> environments_;
  Background background_;
};

}  // namespace minkray
