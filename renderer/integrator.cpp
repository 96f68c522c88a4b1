// SPDX-License-Identifier: MIT
#include "renderer/integrator.h"

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
    const double sign = std::copysign(1.0, z.z());
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

  bool at_camera() const { return bounces == 0 && mirrors == 0; }
};

/// Where a ray met a surface.
struct Integrator::Spot {
  Vec3<double> position;  ///< a little above the surface
  Frame frame;
  Vec3<double> w_out;  ///< where the ray came from, in the frame
  const Surface& surface;
  std::uint32_t instance;
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

Colour Integrator::radiance(const Ray<Real>& ray, Sampler& sampler, RayCounts& counts) const {
  ++counts.camera;
  return along(ray, {}, sampler, counts);
}

Colour Integrator::environment(const Vec3<double>& direction) const {
  Colour sum = Colour::Zero();
  for (const EnvironmentLight& light : environments_)
    sum += by_height(light.zenith, light.nadir, direction);
  return sum;
}

bool Integrator::occluded(RayKind kind, const Ray<Real>& ray, std::uint32_t skip,
                          RayCounts& counts) const {
  const bool answer = world_.occluded(ray, counts.work, skip);
  if (options_.audit) options_.audit->occluded(kind, ray, skip, answer);
  return answer;
}

Colour Integrator::along(const Ray<Real>& ray, const Path& path, Sampler& sampler,
                         RayCounts& counts) const {
  const WorldHit<Real> hit = world_.closest_hit(ray, counts.work, path.left);
  if (options_.audit)
    options_.audit->closest(path.at_camera() ? RayKind::camera : RayKind::indirect, ray, path.left,
                            hit);

  // Nothing there: cameras see the background. Surfaces are lit by the environment, and mirror it,
  // so that no light is counted twice; without one they still mirror the background.
  if (!hit.found()) {
    if (path.at_camera()) ++counts.background;
    const bool sees_background = path.bounces == 0 && (path.mirrors == 0 || environments_.empty());
    return sees_background ? by_height(background_.zenith, background_.nadir, ray.direction)
                           : environment(ray.direction);
  }

  // Within a solid it is dark.
  if (hit.cast.status == Status::inside) {
    if (path.at_camera()) ++counts.from_inside;
    return Colour::Zero();
  }

  const Real t = hit.cast.t();
  const Vec3<Real> on_surface = ray.at(t);
  const Real largest =
      std::max({on_surface.cwiseAbs().maxCoeff(), t, world_.instances().half_extent(hit.instance)});
  const Real offset = surface_offset * tolerance::epsilon<Real> * largest;
  const Frame frame(hit.cast.normal.template cast<double>());
  Vec3<double> w_out = frame.to_local(-ray.direction);
  // A grazing normal may be rounded to the far side.
  w_out.z() = std::max(w_out.z(), std::numeric_limits<double>::epsilon());
  const Spot spot{on_surface + offset * frame.z, frame, w_out,
                  surfaces_[surface_of_instance_[hit.instance]], hit.instance};

  const Colour arrived = direct(spot, path, counts);
  if (!spot.surface.has_coat()) return arrived + scattered(spot, path, sampler, counts);

  // What the camera sees directly follows both of the coat and the base, for a quiet picture;
  // behind that, one of the two by chance.
  if (path.at_camera()) {
    const Colour base = scattered(spot, path, sampler, counts);
    return arrived + base + mirrored(spot, path, sampler, counts);
  }
  const double mirror_weight = fresnel(w_out.z(), spot.surface.eta());
  const double base_weight = (1 - mirror_weight) * spot.surface.colour().maxCoeff();
  const double chance = mirror_weight / (mirror_weight + base_weight);
  if (sampler.next()[0] < chance) return arrived + mirrored(spot, path, sampler, counts) / chance;
  return arrived + scattered(spot, path, sampler, counts) / (1 - chance);
}

Colour Integrator::direct(const Spot& spot, const Path& path, RayCounts& counts) const {
  const double least_alpha = path.bounces == 0 ? 0 : least_alpha_behind_bounce;
  Colour sum = Colour::Zero();
  const auto add = [&](const Vec3<double>& towards, double distance, const Colour& irradiance) {
    const Vec3<double> w_in = spot.frame.to_local(towards);
    if (!(w_in.z() > 0)) return;
    ++counts.shadow;
    if (occluded(RayKind::shadow, {spot.position, towards, distance}, spot.instance, counts))
      return;
    const Colour reflected = (spot.surface.base(spot.w_out, w_in).array() +
                              spot.surface.highlight(spot.w_out, w_in, least_alpha))
                                 .matrix();
    sum += w_in.z() * irradiance.cwiseProduct(reflected);
  };
  for (const DirectionalLight& light : directional_)
    add(-light.direction, std::numeric_limits<double>::infinity(), light.colour);
  for (const PointLight& light : points_) {
    const Vec3<double> to_light = light.position - spot.position;
    const double distance = to_light.norm();
    if (distance > 0) add(to_light / distance, distance, light.colour / (distance * distance));
  }
  return sum;
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
    if (occluded(RayKind::ambient, ray, spot.instance, counts)) return Colour::Zero();
    return weight.cwiseProduct(environment(direction));
  }
  ++counts.scattered;
  const Path next{path.bounces + 1, path.mirrors, spot.instance};
  return weight.cwiseProduct(along(ray, next, sampler, counts));
}

Colour Integrator::mirrored(const Spot& spot, const Path& path, Sampler& sampler,
                            RayCounts& counts) const {
  const Surface::Mirrored mirrored = spot.surface.mirror(spot.w_out, sampler.next());
  if (!(mirrored.weight > 0)) return Colour::Zero();
  const Vec3<double> direction = unit(spot.frame.to_world(mirrored.w_in));
  if (path.mirrors >= options_.mirrors) return mirrored.weight * environment(direction);
  ++counts.mirrored;
  const Path next{path.bounces, path.mirrors + 1, spot.instance};
  return mirrored.weight * along({spot.position, direction}, next, sampler, counts);
}

}  // namespace minkray
