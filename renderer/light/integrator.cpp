// SPDX-License-Identifier: MIT
#include "renderer/light/integrator.h"

#include <array>

#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

/// A ray that leaves a surface starts this far above it, in units of rounding (machine epsilon
/// times the largest coordinate that went into the hit spot). Hit spots are off by a few dozen
/// units; the shape itself is left out of the cast, so this only keeps other shapes with a face in
/// the same plane from shading each other.
constexpr Real surface_offset = 256;

/// Sharp highlights that a surface sees in another one (caustics) are found by a few lucky rays:
/// white specks. Behind a scattering, coats are therefore taken to be at least this rough
/// (Kaplanyan and Dachsbacher, "Path Space Regularization", 2013): the light stays, but is spread.
constexpr double least_alpha_behind_bounce = 0.3;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
// Clang finds it by itself only from version 17 on.
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

Colour by_height(const Colour& zenith, const Colour& nadir, const Vec3<double>& direction) {
  const double up = 0.5 + 0.5 * direction.z();
  return up * zenith + (1 - up) * nadir;
}

/// Two directions across a unit normal (Duff et al., "Building an Orthonormal Basis, Revisited",
/// 2017).
struct Frame {
  Vec3<double> x, y, z;

  explicit Frame(const Vec3<double>& normal) : z(normal) {
    // Where the two halves meet neighbouring samples see different patterns: not at z = 0, where
    // the upright faces are.
    const double sign = z.z() < -0.6 ? -1.0 : 1.0;
    const double a = -1 / (sign + z.z()), b = z.x() * z.y() * a;
    x = {1 + sign * z.x() * z.x() * a, sign * b, -sign * z.x()};
    y = {b, sign + z.y() * z.y() * a, -z.y()};
  }
  Vec3<double> to_local(const Vec3<double>& v) const { return {v.dot(x), v.dot(y), v.dot(z)}; }
  Vec3<double> to_world(const Vec3<double>& v) const { return v.x() * x + v.y() * y + v.z() * z; }
};

}  // namespace

RayCounts& RayCounts::operator+=(const RayCounts& other) {
  camera += other.camera;
  shadow += other.shadow;
  ambient += other.ambient;
  scattered += other.scattered;
  mirrored += other.mirrored;
  background += other.background;
  from_inside += other.from_inside;
  work += other.work;
  return *this;
}

/// What came before the ray.
struct Integrator::Path {
  int bounces = 0;
  int mirrors = 0;
  std::uint32_t left = no_instance;  ///< the instance that the ray leaves
  Real time = 0;                     ///< while the shutter is open: from 0 to 1

  bool at_camera() const { return bounces == 0 && mirrors == 0; }
};

/// Where a ray met a surface.
struct Integrator::Spot {
  Vec3<double> position;  ///< a little above the surface
  Frame frame;
  Vec3<double> w_out;  ///< where the ray came from, in the frame
  const Surface& surface;
  std::uint32_t instance;
  Real time;
};

/// The way to a light, and what comes from there.
struct Integrator::ShadowRay {
  Ray<Real> ray;
  Vec3<double> w_in;  ///< in the spot's frame
  Colour irradiance;
};

Integrator::Integrator(const Scene& scene, const RenderWorld& world,
                       const IntegratorOptions& options)
    : world_(world), options_(options), background_(scene.background) {
  for (const Material& material : scene.materials) surfaces_.emplace_back(material);
  surface_of_instance_.reserve(instance_count(scene));
  for (const Object& object : scene.objects) surface_of_instance_.push_back(object.material);
  for (const ParticleSet& set : scene.particles)
    for (std::size_t i = 0; i < set.size(); ++i) surface_of_instance_.push_back(set.material(i));
  for (const Light& light : scene.lights)
    std::visit(Overloaded{[&](const DirectionalLight& l) { directional_.push_back(l); },
                          [&](const PointLight& l) { points_.push_back(l); },
                          [&](const EnvironmentLight& l) { environments_.push_back(l); }},
               light);
  for (DirectionalLight& light : directional_) light.direction = unit(light.direction);
}

Colour Integrator::radiance(const Ray<Real>& ray, Sampler& sampler, RayCounts& counts,
                            Real time) const {
  ++counts.camera;
  return along(ray, {0, 0, no_instance, time}, sampler, counts);
}

Colour Integrator::environment(const Vec3<double>& direction) const {
  Colour sum = Colour::Zero();
  for (const EnvironmentLight& light : environments_)
    sum += by_height(light.zenith, light.nadir, direction);
  return sum;
}

bool Integrator::occluded(RayKind kind, const Ray<Real>& ray, const Spot& from,
                          RayCounts& counts) const {
  const bool answer = world_.occluded(ray, counts.work, from.instance, from.time);
  if (options_.audit) options_.audit->occluded(kind, ray, from.instance, answer);
  return answer;
}

Colour Integrator::along(const Ray<Real>& ray, const Path& path, Sampler& sampler,
                         RayCounts& counts) const {
  const WorldHit<Real> hit = world_.closest_hit(ray, counts.work, path.left, path.time);
  if (options_.audit)
    options_.audit->closest(path.at_camera() ? RayKind::camera : RayKind::indirect, ray, path.left,
                            hit);
  if (hit.cast.status != Status::hit) return off_surface(ray, hit, path, counts);
  const Spot spot = spot_of(ray, hit, path.time);
  return from_spot(spot, direct(spot, path, counts), path, sampler, counts);
}

/// The camera rays together, then the shadow rays of what they meet, light by light. What comes
/// behind is scattered too widely to gain by it (docs/decisions/rays-together.md).
void Integrator::trace(std::span<CameraRay> rays, RayCounts& counts) const {
  if (rays.size() == 1) {
    const std::uint64_t background = counts.background;
    rays[0].radiance = radiance(rays[0].ray, rays[0].sampler, counts, rays[0].time);
    rays[0].met = counts.background == background;
    return;
  }
  std::array<WorldRay<Real>, most_in_packet> asked;
  std::array<WorldHit<Real>, most_in_packet> hits;
  std::array<std::optional<Spot>, most_in_packet> spots;
  std::array<Colour, most_in_packet> arrived;
  const std::size_t count = rays.size();
  for (std::size_t i = 0; i < count; ++i) asked[i] = {rays[i].ray, no_instance, rays[i].time};
  counts.camera += count;
  world_.closest_hits(std::span(asked).first(count), hits, counts.work);

  const Path at_camera;
  for (std::size_t i = 0; i < count; ++i) {
    if (options_.audit) options_.audit->closest(RayKind::camera, rays[i].ray, no_instance, hits[i]);
    rays[i].met = hits[i].found();
    if (hits[i].cast.status == Status::hit)
      spots[i].emplace(spot_of(rays[i].ray, hits[i], rays[i].time));
    else
      rays[i].radiance = off_surface(rays[i].ray, hits[i], at_camera, counts);
  }
  direct(std::span(spots).first(count), at_camera, arrived, counts);
  for (std::size_t i = 0; i < count; ++i)
    if (spots[i])
      rays[i].radiance = from_spot(*spots[i], arrived[i], at_camera, rays[i].sampler, counts);
}

/// Of a ray that meets nothing, or begins in a shape.
Colour Integrator::off_surface(const Ray<Real>& ray, const WorldHit<Real>& hit, const Path& path,
                               RayCounts& counts) const {
  // Nothing there: cameras see the background. Surfaces are lit by the environment, and mirror it,
  // so that no light is counted twice; without one they still mirror the background.
  if (!hit.found()) {
    if (path.at_camera()) ++counts.background;
    const bool sees_background = path.bounces == 0 && (path.mirrors == 0 || environments_.empty());
    return sees_background ? by_height(background_.zenith, background_.nadir, ray.direction)
                           : environment(ray.direction);
  }
  // Within a solid it is dark.
  if (path.at_camera()) ++counts.from_inside;
  return Colour::Zero();
}

Integrator::Spot Integrator::spot_of(const Ray<Real>& ray, const WorldHit<Real>& hit,
                                     Real time) const {
  const Real t = hit.cast.t();
  const Vec3<Real> on_surface = ray.at(t);
  const Real largest =
      std::max({on_surface.cwiseAbs().maxCoeff(), t, world_.instances().half_extent(hit.instance)});
  const Real offset = surface_offset * tolerance::epsilon<Real> * largest;
  const Frame frame(hit.cast.normal.template cast<double>());
  Vec3<double> w_out = frame.to_local(-ray.direction);
  // A grazing normal may be rounded to the far side.
  w_out.z() = std::max(w_out.z(), std::numeric_limits<double>::epsilon());
  return {on_surface + offset * frame.z,
          frame,
          w_out,
          surfaces_[surface_of_instance_[hit.instance]],
          hit.instance,
          time};
}

/// `arrived` is the direct light.
Colour Integrator::from_spot(const Spot& spot, const Colour& arrived, const Path& path,
                             Sampler& sampler, RayCounts& counts) const {
  if (!spot.surface.has_coat()) return arrived + scattered(spot, path, sampler, counts);

  // What the camera sees directly follows both of the coat and the base, for a quiet picture;
  // behind that, one of the two by chance.
  if (path.at_camera()) {
    const Colour base = scattered(spot, path, sampler, counts);
    return arrived + base + mirrored(spot, path, sampler, counts);
  }
  const double mirror_weight = fresnel(spot.w_out.z(), spot.surface.eta());
  const double base_weight = (1 - mirror_weight) * spot.surface.colour().maxCoeff();
  const double chance = mirror_weight / (mirror_weight + base_weight);
  if (sampler.next()[0] < chance) return arrived + mirrored(spot, path, sampler, counts) / chance;
  return arrived + scattered(spot, path, sampler, counts) / (1 - chance);
}

/// Directional lights first, then points. Nothing for lights behind the surface.
std::optional<Integrator::ShadowRay> Integrator::shadow_ray(std::size_t light,
                                                            const Spot& spot) const {
  const auto from = [&](const Vec3<double>& towards, double distance,
                        const Colour& irradiance) -> std::optional<ShadowRay> {
    const Vec3<double> w_in = spot.frame.to_local(towards);
    if (!(w_in.z() > 0)) return std::nullopt;
    return ShadowRay{{spot.position, towards, distance}, w_in, irradiance};
  };
  if (light < directional_.size()) {
    const DirectionalLight& sun = directional_[light];
    return from(-sun.direction, std::numeric_limits<double>::infinity(), sun.colour);
  }
  const PointLight& lamp = points_[light - directional_.size()];
  const Vec3<double> to_light = lamp.position - spot.position;
  const double distance = to_light.norm();
  if (!(distance > 0)) return std::nullopt;
  return from(to_light / distance, distance, lamp.colour / (distance * distance));
}

/// What the surface makes of a light that nothing is in front of.
Colour Integrator::unblocked(const ShadowRay& light, const Spot& spot, const Path& path) const {
  const double least_alpha = path.bounces == 0 ? 0 : least_alpha_behind_bounce;
  const Colour reflected = (spot.surface.base(spot.w_out, light.w_in).array() +
                            spot.surface.highlight(spot.w_out, light.w_in, least_alpha))
                               .matrix();
  return light.w_in.z() * light.irradiance.cwiseProduct(reflected);
}

Colour Integrator::direct(const Spot& spot, const Path& path, RayCounts& counts) const {
  Colour sum = Colour::Zero();
  for (std::size_t light = 0; light < light_count(); ++light) {
    const std::optional<ShadowRay> shadow = shadow_ray(light, spot);
    if (!shadow) continue;
    ++counts.shadow;
    if (occluded(RayKind::shadow, shadow->ray, spot, counts)) continue;
    sum += unblocked(*shadow, spot, path);
  }
  return sum;
}

/// The same for many spots.
void Integrator::direct(std::span<const std::optional<Spot>> spots, const Path& path,
                        std::span<Colour> arrived, RayCounts& counts) const {
  std::array<WorldRay<Real>, most_in_packet> asked;
  std::array<std::optional<ShadowRay>, most_in_packet> shadows;
  for (std::size_t i = 0; i < spots.size(); ++i) arrived[i].setZero();
  for (std::size_t light = 0; light < light_count(); ++light) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < spots.size(); ++i) {
      shadows[i].reset();
      if (spots[i]) shadows[i] = shadow_ray(light, *spots[i]);
      if (shadows[i]) asked[count++] = {shadows[i]->ray, spots[i]->instance, spots[i]->time};
    }
    counts.shadow += count;
    const std::span<const WorldRay<Real>> rays = std::span(asked).first(count);
    BeamRays blocked = world_.occluded(rays, counts.work);
    if (options_.audit)
      for (std::size_t k = 0; k < count; ++k)
        options_.audit->occluded(RayKind::shadow, rays[k].ray, rays[k].skip, blocked >> k & 1);
    for (std::size_t i = 0; i < spots.size(); ++i) {
      if (!shadows[i]) continue;
      if (!(blocked & 1)) arrived[i] += unblocked(*shadows[i], *spots[i], path);
      blocked >>= 1;
    }
  }
}

Colour Integrator::scattered(const Spot& spot, const Path& path, Sampler& sampler,
                             RayCounts& counts) const {
  const bool last = path.bounces >= options_.bounces;
  if (last && environments_.empty()) return Colour::Zero();
  const Vec3<double> w_in = cosine_direction(sampler.next());
  const Vec3<double> direction = unit(spot.frame.to_world(w_in));
  const Colour weight = spot.surface.base_weight(spot.w_out, w_in);
  const Ray<Real> ray{spot.position, direction};
  if (last) {
    ++counts.ambient;
    if (occluded(RayKind::ambient, ray, spot, counts)) return Colour::Zero();
    return weight.cwiseProduct(environment(direction));
  }
  ++counts.scattered;
  const Path next{path.bounces + 1, path.mirrors, spot.instance, spot.time};
  return weight.cwiseProduct(along(ray, next, sampler, counts));
}

Colour Integrator::mirrored(const Spot& spot, const Path& path, Sampler& sampler,
                            RayCounts& counts) const {
  const Surface::Mirrored mirrored = spot.surface.mirror(spot.w_out, sampler.next());
  if (!(mirrored.weight > 0)) return Colour::Zero();
  const Vec3<double> direction = unit(spot.frame.to_world(mirrored.w_in));
  if (path.mirrors >= options_.mirrors) return mirrored.weight * environment(direction);
  ++counts.mirrored;
  const Path next{path.bounces, path.mirrors + 1, spot.instance, spot.time};
  return mirrored.weight * along({spot.position, direction}, next, sampler, counts);
}

}  // namespace minkray
