// SPDX-License-Identifier: MIT
#include "renderer/light/ambient_transport.h"

#include <array>
#include <limits>
#include <optional>

#include "renderer/light/frame.h"
#include "renderer/light/inside.h"
#include "renderer/light/scene_surfaces.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

/// Sharp highlights that a surface sees in another one (caustics) are found by a few lucky rays:
/// white specks. Behind a scattering, coats are therefore taken to be at least this rough
/// (Kaplanyan and Dachsbacher, "Path Space Regularization", 2013): the light stays, but is spread.
constexpr double least_alpha_behind_bounce = 0.3;

}  // namespace

/// What came before rays that go together.
struct AmbientTransport::Path {
  int bounces = 0;
  int mirrors = 0;

  bool at_camera() const { return bounces == 0 && mirrors == 0; }
};

/// Where a ray met a surface.
struct AmbientTransport::HitPoint {
  Vec3<double> position;  ///< a little above the surface
  Frame frame;
  Vec3<double> w_out;  ///< where the ray came from, in the frame
  const Surface& surface;
  std::uint32_t instance;
  Real time;
};

AmbientTransport::AmbientTransport(const Scene& scene, const RenderWorld& world,
                                   const IntegratorOptions& options)
    : world_(world),
      options_(options),
      surface_of_instance_(material_of_instance(scene)),
      lights_(scene.lights),
      background_(scene.background.zenith, scene.background.nadir) {
  for (const Material& material : scene.materials) {
    surfaces_.emplace_back(material);
    radiance_.push_back(radiance_of(scene, material));
  }
}

void AmbientTransport::trace(std::span<TracedRay> rays, RayCounts& counts) const {
  counts.camera += rays.size();
  if (rays.size() == 1)
    follow<1>(rays, {}, counts);
  else
    follow<most_in_ray_group>(rays, {}, counts);
}

/// The rays together, then the shadow rays of what they meet, light by light. What comes behind is
/// scattered too widely to gain by it, and goes alone (docs/decisions/rays-together.md): with room
/// for one ray, so that the stack holds paths of many bounces.
template <std::size_t most>
void AmbientTransport::follow(std::span<TracedRay> rays, const Path& path,
                              RayCounts& counts) const {
  std::array<WorldRay<Real>, most> asked;
  std::array<WorldHit<Real>, most> hits;
  std::array<std::optional<HitPoint>, most> points;
  const std::size_t count = rays.size();
  for (std::size_t i = 0; i < count; ++i) asked[i] = {rays[i].ray, rays[i].left, rays[i].time};
  world_.closest_hits(std::span(asked).first(count), hits, counts.work);

  const RayKind kind = path.at_camera() ? RayKind::camera : RayKind::indirect;
  for (std::size_t i = 0; i < count; ++i) {
    if (options_.observer) options_.observer->closest(kind, rays[i].ray, rays[i].left, hits[i]);
    rays[i].met = hits[i].found();
    rays[i].radiance.setZero();
    if (hits[i].cast.status == Status::hit) {
      points[i].emplace(hit_point(rays[i], hits[i]));
      rays[i].radiance = radiance_[surface_of_instance_[hits[i].instance]];
    } else
      rays[i].radiance = off_surface(rays[i].ray, hits[i], path, counts);
  }
  add_direct<most>(rays, std::span(points).first(count), path, counts);
  for (std::size_t i = 0; i < count; ++i)
    if (points[i])
      rays[i].radiance = indirect(*points[i], rays[i].radiance, path, rays[i].sampler, counts);
}

/// The light that comes to a point from a direction, by a ray of its own.
Colour AmbientTransport::behind(const HitPoint& point, const Vec3<double>& direction,
                                const Path& path, Sampler& sampler, RayCounts& counts) const {
  TracedRay ray{{point.position, direction}, sampler};
  ray.time = point.time;
  ray.left = point.instance;
  follow<1>(std::span(&ray, 1), path, counts);
  sampler = ray.sampler;
  return ray.radiance;
}

/// What a ray sees that meets nothing, or begins in a shape.
Colour AmbientTransport::off_surface(const Ray<Real>& ray, const WorldHit<Real>& hit,
                                     const Path& path, RayCounts& counts) const {
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
                                                       const WorldHit<Real>& hit) const {
  const Real t = hit.cast.t();
  const Vec3<Real> on_surface = ray.ray.at(t);
  const Real offset = rounding_at(world_, hit.instance, on_surface, t);
  const Frame frame(hit.cast.normal.template cast<double>());
  Vec3<double> w_out = frame.to_local(-ray.ray.direction);
  // A grazing normal may be rounded to the far side.
  w_out.z() = std::max(w_out.z(), std::numeric_limits<double>::epsilon());
  return {on_surface + offset * frame.z,
          frame,
          w_out,
          surfaces_[surface_of_instance_[hit.instance]],
          hit.instance,
          ray.time};
}

/// Bit i answers rays[i].
RayGroupMask AmbientTransport::blocked(RayKind kind, std::span<const WorldRay<Real>> rays,
                                       RayCounts& counts) const {
  const RayGroupMask answers = world_.occluded(rays, counts.work);
  if (options_.observer)
    for (std::size_t i = 0; i < rays.size(); ++i)
      options_.observer->occluded(kind, rays[i].ray, rays[i].skip, answers >> i & 1);
  return answers;
}

/// Adds to each ray's radiance what lights send straight to where it met a surface. Nothing for
/// lights behind the surface.
template <std::size_t most>
void AmbientTransport::add_direct(std::span<TracedRay> rays,
                                  std::span<const std::optional<HitPoint>> points, const Path& path,
                                  RayCounts& counts) const {
  /// What a light sends to the point that a ray met, if nothing is in its way.
  struct Arriving {
    std::size_t ray;
    Vec3<double> w_in;
    Colour irradiance;
  };
  std::array<WorldRay<Real>, most> asked;
  std::array<Arriving, most> arriving;
  const double least_alpha = path.bounces == 0 ? 0 : least_alpha_behind_bounce;
  for (std::size_t light = 0; light < lights_.count(); ++light) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (!points[i]) continue;
      const HitPoint& point = *points[i];
      const auto sample = lights_.sample(light, point.position, rays[i].sampler);
      if (!sample) continue;
      const Vec3<double> w_in = point.frame.to_local(sample->direction);
      if (!(w_in.z() > 0)) continue;
      asked[count] = {
          {point.position, sample->direction, sample->distance}, point.instance, point.time};
      arriving[count++] = {i, w_in, sample->weight};
    }
    counts.shadow += count;
    const RayGroupMask answers = blocked(RayKind::shadow, std::span(asked).first(count), counts);
    for (std::size_t k = 0; k < count; ++k) {
      if (answers >> k & 1) continue;
      const auto& [i, w_in, irradiance] = arriving[k];
      const Colour reflected = points[i]->surface.eval(points[i]->w_out, w_in, least_alpha);
      rays[i].radiance += w_in.z() * irradiance.cwiseProduct(reflected);
    }
  }
}

/// `direct` and what comes to the point by way of other surfaces and from the environment.
Colour AmbientTransport::indirect(const HitPoint& point, const Colour& direct, const Path& path,
                                  Sampler& sampler, RayCounts& counts) const {
  const std::optional<Coat>& coat = point.surface.coat();
  if (!coat) return direct + scattered(point, path, sampler, counts);

  // What the camera sees directly follows both of the coat and the base, for a quiet picture;
  // behind that, one of the two by chance.
  if (path.at_camera()) {
    const Colour base = scattered(point, path, sampler, counts);
    return direct + base + mirrored(point, *coat, path, sampler, counts);
  }
  const double chance = point.surface.chance_of_coat(point.w_out);
  if (sampler.next()[0] < chance)
    return direct + mirrored(point, *coat, path, sampler, counts) / chance;
  return direct + scattered(point, path, sampler, counts) / (1 - chance);
}

Colour AmbientTransport::scattered(const HitPoint& point, const Path& path, Sampler& sampler,
                                   RayCounts& counts) const {
  const bool last = path.bounces >= options_.bounces;
  if (last && !lights_.has_environment()) return Colour::Zero();
  const SurfaceSample sample = point.surface.base().sample(point.w_out, sampler.next());
  const Vec3<double> direction = unit(point.frame.to_world(sample.w_in));
  if (last) {
    ++counts.ambient;
    const WorldRay<Real> ray{{point.position, direction}, point.instance, point.time};
    if (blocked(RayKind::ambient, std::span(&ray, 1), counts)) return Colour::Zero();
    return sample.weight.cwiseProduct(lights_.environment(direction));
  }
  ++counts.scattered;
  const Path next{path.bounces + 1, path.mirrors};
  return sample.weight.cwiseProduct(behind(point, direction, next, sampler, counts));
}

Colour AmbientTransport::mirrored(const HitPoint& point, const Coat& coat, const Path& path,
                                  Sampler& sampler, RayCounts& counts) const {
  const SurfaceSample sample = coat.sample(point.w_out, sampler.next());
  if (!(sample.weight.array() > 0).any()) return Colour::Zero();
  const Vec3<double> direction = unit(point.frame.to_world(sample.w_in));
  if (path.mirrors >= options_.mirrors)
    return sample.weight.cwiseProduct(lights_.environment(direction));
  ++counts.mirrored;
  const Path next{path.bounces, path.mirrors + 1};
  return sample.weight.cwiseProduct(behind(point, direction, next, sampler, counts));
}

}  // namespace minkray
