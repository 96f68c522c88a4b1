// SPDX-License-Identifier: MIT
// The light that arrives along a ray: direct light with shadows, mirrored light, and light
// scattered by surfaces that the environment and other surfaces shine on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/light/lights.h"
#include "renderer/light/ray_counts.h"
#include "renderer/light/ray_observer.h"
#include "renderer/light/reflection.h"
#include "renderer/light/sampler.h"
#include "renderer/scene/scene.h"

namespace minkray {

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
  RayObserver* observer = nullptr;
};

/// A ray and where its light comes to.
struct TracedRay {
  Ray<Real> ray;  ///< of unit direction
  Sampler sampler;
  Colour radiance = Colour::Zero();
  bool met = false;                  ///< whether it met an object
  Real time = 0;                     ///< while the shutter is open: from 0 to 1
  std::uint32_t left = no_instance;  ///< the instance that it leaves
};

/// No more rays can be traced together.
inline constexpr int most_in_packet = most_rays_at_once;

/// Refers to the scene's world; keeps everything else itself. Any number of threads may ask.
class Integrator {
 public:
  Integrator(const Scene& scene, const RenderWorld& world, const IntegratorOptions& options = {});

  /// Fills in what camera rays see, at most most_in_packet at once: one ray is a span of one. What
  /// a ray sees does not depend on the others. Instances of the scene and of the world share their
  /// indices.
  void trace(std::span<TracedRay> rays, RayCounts& counts) const;

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
  Lights lights_;
  EnvironmentSource background_;
};

}  // namespace minkray
