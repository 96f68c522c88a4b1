// SPDX-License-Identifier: MIT
#include "renderer/paths/ambient_transport.h"

#include <limits>
#include <optional>
#include <vector>

#include "renderer/paths/inside.h"
#include "renderer/rays/frame.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/surfaces/scene_surfaces.h"

namespace minkray {
namespace {

/// Sharp highlights that a surface sees in another one (caustics) are found by a few lucky rays:
/// white specks. Behind a scattering, coats are therefore taken to be at least this rough
/// (Kaplanyan and Dachsbacher, "Path Space Regularization", 2013): the light stays, but is spread.
constexpr double least_alpha_behind_bounce = 0.3;

}  // namespace

/// State before rays that go together.
struct AmbientTransport::Path {
  int bounces = 0;
  int mirrors = 0;

  bool at_camera() const { return bounces == 0 && mirrors == 0; }
  /// Camera rays of neighbouring pixels go side by side, and shadow rays of what they see.
};

/// Rays that continue together, and what each of them is a continuation of: a place in the wave
/// before.
struct AmbientTransport::Wave {
  std::vector<TracedRay> rays;
  std::vector<std::size_t> from;
  std::vector<Colour> weights;

  void add(std::size_t place, const TracedRay& ray, const Colour& weight) {
    rays.push_back(ray);
    from.push_back(place);
    weights.push_back(weight);
  }
};

/// Hit of a ray with a surface.
struct AmbientTransport::HitPoint {
  Vec3<double> position;  ///< a little above the surface, on a mesh with normals the curved one
  Frame frame;
  Vec3<double> w_out;  ///< direction to the ray's origin, in the frame
  const Surface& surface;
  std::uint32_t instance;
  double time;
  Vec3<double> normal;   ///< geometric; the frame's may be a mesh's interpolated one
  Vec3<double> lift;     ///< of the position, from the triangle
  Vec3<double> horizon;  ///< scattered light comes from this side: the normal, or the mesh's own

  /// True if a direction above the frame's plane is above the surface, too.
  bool is_above(const Vec3<double>& direction, bool is_mirrored = false) const {
    return frame.z == normal || direction.dot(is_mirrored ? normal : horizon) > 0;
  }
};

AmbientTransport::AmbientTransport(const Scene& scene, const World& world,
                                   const IntegratorOptions& options)
    : world_(world),
      casts_(world, options),
      options_(options),
      surface_of_instance_(material_of_instance(scene)),
      looks_(scene),
      lights_(scene.lights),
      background_(scene.background.zenith, scene.background.nadir) {
  for (const Material& material : scene.materials) {
    surfaces_.emplace_back(material);
    radiance_.push_back(radiance_of(scene, material));
  }
}

void AmbientTransport::trace(std::span<TracedRay> rays, RayCounts& counts) const {
  counts.camera += rays.size();
  follow(rays, {}, counts);
}

/// The rays as one wave, then the shadow rays of what they meet, light by light, then light that
/// arrives via other surfaces, as waves of their own. The order of a ray's random numbers is that
/// of a ray by itself, whatever rays are traced with it.
void AmbientTransport::follow(std::span<TracedRay> rays, const Path& path,
                              RayCounts& counts) const {
  if (rays.empty()) return;
  std::vector<WorldRay> asked;
  std::vector<WorldHit> hits;
  asked.reserve(rays.size());
  const auto kind = path.at_camera() ? RayKind::camera : RayKind::indirect;
  for (const TracedRay& ray : rays) asked.push_back({ray.ray, ray.left, ray.time, kinds_of(kind)});
  casts_.find_hits([&](std::size_t) { return kind; }, asked, hits, counts.work);

  HitPoints points(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    rays[i].met = hits[i].found();
    rays[i].radiance.setZero();
    if (hits[i].cast.status == Status::hit) {
      points[i].emplace(hit_point(rays[i], hits[i]));
      rays[i].radiance = radiance_[surface_of(hits[i])];
    } else
      rays[i].radiance = off_surface(rays[i].ray, hits[i], path, counts);
  }
  add_direct(rays, points, path, counts);
  for (TracedRay& ray : rays) ray.direct = ray.radiance;
  add_indirect(rays, points, path, counts);
}

/// Light of a ray that misses, or begins in a shape.
Colour AmbientTransport::off_surface(const Ray<double>& ray, const WorldHit& hit, const Path& path,
                                     RayCounts& counts) const {
  // Nothing there: cameras see the background. Surfaces are lit by the environment, and mirror it,
  // so that no light is counted twice; without one they still mirror the background.
  if (!hit.found()) {
    if (path.at_camera()) ++counts.background;
    const bool sees_background =
        path.bounces == 0 && (path.mirrors == 0 || !lights_.has_environment());
    return sees_background ? background_.eval(ray.direction) : lights_.environment(ray.direction);
  }
  // Within a solid it is dark.
  if (path.at_camera()) ++counts.from_inside;
  return Colour::Zero();
}

AmbientTransport::HitPoint AmbientTransport::hit_point(const TracedRay& ray,
                                                       const WorldHit& hit) const {
  const double t = hit.cast.t();
  const Vec3<double> on_surface = ray.ray.at(t);
  const double offset = rounding_at(world_, hit.instance, on_surface, t);
  const Vec3<double> normal = hit.cast.normal;
  SmoothPoint smooth{normal};
  if (looks_.has_normals(hit.instance)) {
    smooth = looks_.smooth(world_, surface_hit(hit), on_surface, ray.time);
    smooth.normal = seen_normal(smooth.normal, ray.ray.direction, false);
  }
  const Frame frame(smooth.normal);
  Vec3<double> w_out = frame.to_local(-ray.ray.direction);
  // A grazing normal may be rounded to the far side.
  w_out.z() = std::max(w_out.z(), std::numeric_limits<double>::epsilon());
  return {on_surface + offset * normal + smooth.lift,
          frame,
          w_out,
          surfaces_[surface_of(hit)],
          hit.instance,
          ray.time,
          normal,
          smooth.lift,
          smooth.is_curved ? smooth.normal : normal};
}

/// Adds to each ray's radiance what lights send straight to where it met a surface. Nothing for
/// lights behind the surface.
void AmbientTransport::add_direct(std::span<TracedRay> rays, const HitPoints& points,
                                  const Path& path, RayCounts& counts) const {
  /// Light that arrives at a ray's hit point, if unoccluded.
  struct Arriving {
    std::size_t ray;
    Vec3<double> w_in;
    Colour irradiance;
  };
  std::vector<WorldRay> asked;
  std::vector<Arriving> arriving;
  std::vector<std::uint8_t> met;
  const double least_alpha = path.bounces == 0 ? 0 : least_alpha_behind_bounce;
  for (std::size_t light = 0; light < lights_.count(); ++light) {
    asked.clear();
    arriving.clear();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (!points[i]) continue;
      const HitPoint& point = *points[i];
      const auto sample = lights_.sample(light, point.position, rays[i].sampler);
      if (!sample) continue;
      const Vec3<double> w_in = point.frame.to_local(sample->direction);
      if (!(w_in.z() > 0) || !point.is_above(sample->direction)) continue;
      asked.push_back({{point.position, sample->direction, sample->distance},
                       point.instance,
                       point.time,
                       shadow_rays});
      arriving.push_back({i, w_in, sample->weight});
    }
    counts.shadow += asked.size();
    casts_.find_blocked(RayKind::shadow, asked, met, counts.work);
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (met[k]) continue;
      const auto& [i, w_in, irradiance] = arriving[k];
      const Colour reflected = points[i]->surface.eval(points[i]->w_out, w_in, least_alpha);
      rays[i].radiance += w_in.z() * irradiance.cwiseProduct(reflected);
    }
  }
}

/// Adds light that arrives at the points via other surfaces and from the environment.
void AmbientTransport::add_indirect(std::span<TracedRay> rays, const HitPoints& points,
                                    const Path& path, RayCounts& counts) const {
  // Hits that the camera sees directly follow both the coat and its base, for less noise; later
  // hits follow one of the two by chance.
  std::vector<std::size_t> bases, coats;
  std::vector<double> chances(rays.size(), 1);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!points[i]) continue;
    const bool is_coated = points[i]->surface.coat().has_value();
    if (!is_coated || path.at_camera()) bases.push_back(i);
    if (!is_coated) continue;
    if (path.at_camera()) {
      coats.push_back(i);
      continue;
    }
    const double chance = points[i]->surface.chance_of_coat(points[i]->w_out);
    const bool takes_coat = rays[i].sampler.next()[0] < chance;
    (takes_coat ? coats : bases).push_back(i);
    chances[i] = takes_coat ? chance : 1 - chance;
  }
  add_scattered(rays, points, bases, chances, path, counts);
  add_mirrored(rays, points, coats, chances, path, counts);
}

void AmbientTransport::add_scattered(std::span<TracedRay> rays, const HitPoints& points,
                                     std::span<const std::size_t> which,
                                     std::span<const double> chances, const Path& path,
                                     RayCounts& counts) const {
  const bool last = path.bounces >= options_.bounces;
  if (last && !lights_.has_environment()) return;
  Wave wave;
  for (const std::size_t i : which) {
    const HitPoint& point = *points[i];
    const SurfaceSample sample = point.surface.base().sample(point.w_out, rays[i].sampler.next());
    const Vec3<double> direction = unit(point.frame.to_world(sample.w_in));
    if (!point.is_above(direction)) continue;
    wave.add(i, behind(point, direction, rays[i].sampler), sample.weight);
  }
  if (last) {
    counts.ambient += wave.rays.size();
    std::vector<WorldRay> asked;
    for (const TracedRay& ray : wave.rays)
      asked.push_back({ray.ray, ray.left, ray.time, kinds_of(RayKind::ambient)});
    std::vector<std::uint8_t> met;
    casts_.find_blocked(RayKind::ambient, asked, met, counts.work);
    for (std::size_t k = 0; k < asked.size(); ++k)
      if (!met[k]) wave.rays[k].radiance = lights_.environment(wave.rays[k].ray.direction);
  } else {
    counts.scattered += wave.rays.size();
    follow(wave.rays, {path.bounces + 1, path.mirrors}, counts);
  }
  take_back(wave, rays, chances);
}

void AmbientTransport::add_mirrored(std::span<TracedRay> rays, const HitPoints& points,
                                    std::span<const std::size_t> which,
                                    std::span<const double> chances, const Path& path,
                                    RayCounts& counts) const {
  Wave wave;
  for (const std::size_t i : which) {
    const HitPoint& point = *points[i];
    const SurfaceSample sample = point.surface.coat()->sample(point.w_out, rays[i].sampler.next());
    if (!(sample.weight.array() > 0).any()) continue;
    const Vec3<double> direction = unit(point.frame.to_world(sample.w_in));
    if (!point.is_above(direction, true)) continue;
    TracedRay mirrored = behind(point, direction, rays[i].sampler);
    mirrored.ray.origin -= point.lift;
    wave.add(i, mirrored, sample.weight);
  }
  if (path.mirrors >= options_.mirrors) {
    for (TracedRay& ray : wave.rays) ray.radiance = lights_.environment(ray.ray.direction);
  } else {
    counts.mirrored += wave.rays.size();
    follow(wave.rays, {path.bounces, path.mirrors + 1}, counts);
  }
  take_back(wave, rays, chances);
}

/// A ray from a point on, which takes the ray's random numbers with it.
TracedRay AmbientTransport::behind(const HitPoint& point, const Vec3<double>& direction,
                                   const Sampler& sampler) {
  TracedRay ray{{point.position, direction}, sampler};
  ray.time = point.time;
  ray.left = point.instance;
  return ray;
}

void AmbientTransport::take_back(const Wave& wave, std::span<TracedRay> rays,
                                 std::span<const double> chances) {
  for (std::size_t k = 0; k < wave.rays.size(); ++k) {
    TracedRay& ray = rays[wave.from[k]];
    ray.sampler = wave.rays[k].sampler;
    ray.radiance += wave.weights[k].cwiseProduct(wave.rays[k].radiance) / chances[wave.from[k]];
  }
}

}  // namespace minkray
