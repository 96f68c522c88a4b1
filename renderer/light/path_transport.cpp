// SPDX-License-Identifier: MIT
#include "renderer/light/path_transport.h"

#include <cmath>
#include <optional>

#include "renderer/light/path_state.h"

namespace minkray {
namespace {

/// Paths are not ended by chance before they were scattered so often.
constexpr int sure_depth = 4;

/// A path goes through no more boundaries that do not count: of bodies within others.
constexpr int most_passages = 256;

/// A body is one sheet if it is so thin, over its largest extent.
constexpr double sheet_thickness = 1e-6;

bool is_flat(const RenderWorld& world, std::uint32_t instance) {
  if (world.instances().is_half_space(instance)) return false;
  const Vec3<double> half = world.instances().at(instance).definition().inner_half_extents();
  return half.minCoeff() <= sheet_thickness * half.maxCoeff();
}

/// The balance heuristic.
double share(double mine, double other) {
  return mine / (mine + other);
}

}  // namespace

/// Paths that go on together.
class PathTransport::Packet {
 public:
  Packet(const PathTransport& of, std::span<TracedRay> rays, RayCounts& counts)
      : of_(of), rays_(rays), counts_(counts) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Path& path = paths_[i];
      path.ray = rays[i].ray;
      path.sampler = rays[i].sampler;
      path.time = rays[i].time;
      path.left = rays[i].left;
    }
  }

  void run() {
    while (find_boundaries()) {
      for (std::size_t i = 0; i < rays_.size(); ++i) {
        points_[i].reset();
        if (paths_[i].goes_on) arrive(i);
      }
      for (std::size_t light = 0; light < of_.lights_.count(); ++light) ask_light(light);
      for (const auto& sky : of_.lights_.skies()) ask_sky(*sky);
      if (!of_.emitters_.none()) ask_emitters();
      for (std::size_t i = 0; i < rays_.size(); ++i)
        if (points_[i]) scatter(paths_[i], *points_[i]);
    }
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      rays_[i].radiance = paths_[i].radiance;
      rays_[i].direct = paths_[i].direct;
    }
  }

 private:
  RayKind kind(const Path& path) const {
    return path.depth == 0 ? RayKind::camera : RayKind::indirect;
  }

  /// False if no path goes on.
  bool find_boundaries() {
    std::array<WorldRay<Real>, most_in_ray_group> asked;
    std::array<std::size_t, most_in_ray_group> whose;
    std::array<WorldHit<Real>, most_in_ray_group> hits;
    std::size_t count = 0;
    bool any = false;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const Path& path = paths_[i];
      if (!path.goes_on) continue;
      any = true;
      const WorldRay<Real> ray{path.ray, path.left, path.time};
      if (path.inside.none()) {
        asked[count] = ray;
        whose[count++] = i;
      } else {
        boundaries_[i] = next_boundary(of_.world_, ray, path.inside, counts_.work);
      }
    }
    if (count > 0) of_.world_.closest_hits(std::span(asked).first(count), hits, counts_.work);
    for (std::size_t k = 0; k < count; ++k) {
      boundaries_[whose[k]] = boundary_of(hits[k]);
      if (of_.options_.observer)
        of_.options_.observer->closest(kind(paths_[whose[k]]), asked[k].ray, asked[k].skip,
                                       hits[k]);
    }
    return any;
  }

  /// The clear body that counts where bodies overlap: of the greatest priority, of equals that
  /// which was entered last.
  const Medium& medium(const Inside& inside, std::uint32_t* which = nullptr) const {
    static constexpr std::uint32_t none = no_instance;
    const Medium* found = &air_;
    std::uint32_t body = none;
    for (const std::uint32_t other : inside.bodies()) {
      const Medium& candidate = of_.surfaces_.of(other).inside;
      if (body != none && candidate.priority < found->priority) continue;
      found = &candidate;
      body = other;
    }
    if (which) *which = body;
    return *found;
  }

  static Colour left_after(const Medium& medium, Real length) {
    if (medium.absorption.isZero(0)) return Colour::Ones();
    return (-medium.absorption * length).array().exp();
  }

  /// Light that the ray finds by itself, and the point where it is to be scattered.
  void arrive(std::size_t i) {
    Path& path = paths_[i];
    const Boundary& at = boundaries_[i];
    const bool is_first = path.depth == 0 && path.passages == 0;
    if (is_first) rays_[i].met = at.instance != no_instance;
    if (at.is_lost || at.instance == no_instance) {
      if (!at.is_lost && path.inside.none()) gather(path, off_surface(path), path.depth);
      path.goes_on = false;
      return;
    }
    const PreparedMaterial& material = of_.surfaces_.of(at.instance);
    if (at.is_within) {
      counts_.from_inside += is_first && !material.bsdf->lets_through() ? 1 : 0;
      pass(path, material.bsdf->lets_through() && path.inside.enter(at.instance));
      return;
    }
    std::uint32_t holder = no_instance;
    const Medium& before = medium(path.inside, &holder);
    if (holder != no_instance) path.throughput.array() *= left_after(before, at.t).array();
    if (!at.leaves) add_emission(path, at, material);

    Inside beyond = path.inside;
    Shading shading;
    if (material.bsdf->lets_through() && !of_.is_flat_sheet(at.instance)) {
      const bool has_room = at.leaves || beyond.enter(at.instance);
      if (at.leaves) beyond.leave(at.instance);
      const bool counts =
          at.leaves ? holder == at.instance
                    : holder == no_instance || material.inside.priority >= before.priority;
      if (!counts || !has_room) {
        path.inside = beyond;
        path.ray.origin = path.ray.at(at.t);
        path.left = at.instance;
        pass(path, has_room);
        return;
      }
      shading.eta_below = material.inside.eta;
      shading.eta_above = at.leaves ? medium(beyond).eta : before.eta;
    }
    if (path.depth >= of_.options_.max_depth) {
      path.goes_on = false;
      return;
    }
    const Vec3<Real> position = path.ray.at(at.t);
    TexturePoint place;
    if (of_.surfaces_.has_textures())
      place = of_.surfaces_.place(of_.world_, at.instance, position, at.normal, path.time);
    const auto frame_of = [&](const Vec3<double>& normal) {
      return material.bsdf->has_grain() ? Frame(normal, of_.surfaces_.axis(at.instance))
                                        : Frame(normal);
    };
    Frame frame = frame_of(at.normal);
    if (material.relief.any()) {
      const Frame bent = frame_of(of_.surfaces_.relief_normal_at(at.instance, place));
      // What is seen from behind its bent normal is seen as it is.
      if ((bent.z.dot(path.ray.direction) > 0) == at.leaves) frame = bent;
    }
    shading.w_out = frame.to_local(-path.ray.direction);
    // A grazing normal may be rounded to the far side.
    constexpr double least = std::numeric_limits<double>::epsilon();
    double& z = shading.w_out.z();
    z = at.leaves ? std::min(z, -least) : std::max(z, least);
    points_[i].emplace(Point{position, rounding_at(of_.world_, at.instance, position, at.t),
                             at.normal, frame, shading, material.bsdf.get(), at.instance,
                             at.leaves ? beyond : path.inside, at.leaves ? path.inside : beyond,
                             place, frame.z != at.normal});
    if (of_.surfaces_.has_textures()) points_[i]->shading.place = &points_[i]->place;
  }

  /// Adds light that was scattered so often; what the camera sees directly and what is lit directly
  /// is never limited.
  void gather(Path& path, const Colour& light, int depth) const {
    if (depth <= 1) path.direct += light;
    const double most = of_.options_.clamp, brightest = light.maxCoeff();
    if (most > 0 && depth > 1 && !path.only_sharp && brightest > most)
      path.radiance += most / brightest * light;
    else
      path.radiance += light;
  }

  /// Goes on through a boundary that does not count, if it can.
  void pass(Path& path, bool can) const {
    path.is_straight = false;
    path.goes_on = can && ++path.passages < most_passages;
  }

  /// What a path sees that meets nothing. Surfaces are lit by the environment and mirror it;
  /// without one they still mirror the background that cameras see.
  Colour off_surface(const Path& path) {
    counts_.background += path.depth == 0 ? 1 : 0;
    const bool sees_background =
        path.only_sharp && (path.depth == 0 || !of_.lights_.has_environment());
    if (sees_background && !of_.background_is_sky_)
      return path.throughput.cwiseProduct(of_.background_.eval(path.ray.direction));
    Colour light = Colour::Zero();
    for (const auto& sky : of_.lights_.skies()) {
      const Colour radiance = sky->eval(path.ray.direction);
      const bool was_asked = sky->is_asked() && !path.is_sharp && path.is_straight;
      const double part =
          was_asked ? share(path.pdf, sky->pdf(path.from, path.ray.direction)) : 1.0;
      light += part * radiance;
    }
    return path.throughput.cwiseProduct(light);
  }

  void add_emission(Path& path, const Boundary& at, const PreparedMaterial& material) const {
    if (!(material.radiance.maxCoeff() > 0)) return;
    double part = 1;
    if (!path.is_sharp && path.is_straight)
      part =
          share(path.pdf, of_.emitters_.pdf(path.from, path.time, path.ray.direction, at.instance));
    gather(path, part * path.throughput.cwiseProduct(material.radiance), path.depth);
  }

  /// Light of a kind to all paths' ends: draw(point, sampler) is a sample of it, and part(point, w,
  /// sample) what counts of that beside what the surface itself draws; 0 is not asked for.
  template <class Draw, class Part>
  void ask_for(const Draw& draw, const Part& part) {
    ShadowRays shadows;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      if (!points_[i] || points_[i]->bsdf->is_sharp()) continue;
      const Point& point = *points_[i];
      const std::optional<LightSample> sample = draw(point, paths_[i].sampler);
      if (!sample) continue;
      const Vec3<double> w = point.frame.to_local(sample->direction);
      if (!point.is_on_side(w, sample->direction) || !point.inside(w).none()) continue;
      const Colour reflected = point.bsdf->eval(point.shading, w);
      if (!(reflected.maxCoeff() > 0)) continue;
      const double counts = part(point, w, *sample);
      if (!(counts > 0)) continue;
      Ray<Real> ray = point.ray(w, sample->direction);
      ray.t_max = sample->distance;
      shadows.add({ray, point.instance, paths_[i].time},
                  {i, counts * sample->weight.cwiseProduct(reflected), no_instance});
    }
    ask(shadows);
  }

  /// Light from the only direction of a light, which no surface draws.
  void ask_light(std::size_t light) {
    ask_for([&](const Point& point,
                Sampler& sampler) { return of_.lights_.sample(light, point.position, sampler); },
            [](const Point&, const Vec3<double>&, const LightSample&) { return 1.0; });
  }

  /// Light from all around, where it is bright.
  void ask_sky(const SkySource& sky) {
    if (!sky.is_asked()) return;
    ask_for(
        [&](const Point& point, Sampler& sampler) { return sky.sample(point.position, sampler); },
        [&](const Point& point, const Vec3<double>& w, const LightSample& sample) {
          const double density = sky.pdf(point.position, sample.direction);
          return density > 0 ? share(density, point.bsdf->pdf(point.shading, w)) : 0.0;
        });
  }

  /// Adds what arrives where nothing is in the way.
  void ask(const ShadowRays& shadows) {
    counts_.shadow += shadows.count;
    const RayGroupMask blocked = of_.world_.occluded(shadows.asked(), counts_.work);
    for (std::size_t k = 0; k < shadows.count; ++k) {
      const bool answer = blocked >> k & 1;
      if (of_.options_.observer)
        of_.options_.observer->occluded(RayKind::shadow, shadows.rays[k].ray, shadows.rays[k].skip,
                                        answer);
      if (!answer) add(shadows.arriving[k]);
    }
  }

  /// Light from one shining body for each path's end, drawn at random. Whether the body is met, and
  /// before anything else, is one question.
  void ask_emitters() {
    ShadowRays shadows;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      if (!points_[i] || points_[i]->bsdf->is_sharp()) continue;
      const Point& point = *points_[i];
      Path& path = paths_[i];
      const auto sample = of_.emitters_.sample(point.position, path.time, path.sampler);
      if (!sample) continue;
      const Vec3<double> w = point.frame.to_local(sample->direction);
      if (!point.is_on_side(w, sample->direction)) continue;
      const Colour reflected = point.bsdf->eval(point.shading, w);
      if (!(reflected.maxCoeff() > 0)) continue;
      const double part = share(sample->pdf, point.bsdf->pdf(point.shading, w)) / sample->pdf;
      const Arriving light{i,
                           part * of_.emitters_.radiance(sample->emitter).cwiseProduct(reflected),
                           of_.emitters_.instance(sample->emitter)};
      const WorldRay<Real> ray{point.ray(w, sample->direction), point.instance, path.time};
      if (point.inside(w).none())
        shadows.add(ray, light);
      else
        ask_within(ray, point.inside(w), light);
    }
    counts_.shadow += shadows.count;
    std::array<WorldHit<Real>, most_in_ray_group> hits;
    if (shadows.count > 0) of_.world_.closest_hits(shadows.asked(), hits, counts_.work);
    for (std::size_t k = 0; k < shadows.count; ++k) {
      if (of_.options_.observer)
        of_.options_.observer->closest(RayKind::shadow, shadows.rays[k].ray, shadows.rays[k].skip,
                                       hits[k]);
      if (hits[k].instance == shadows.arriving[k].emitter && hits[k].cast.status == Status::hit)
        add(shadows.arriving[k]);
    }
  }

  /// Asks within clear bodies.
  void ask_within(const WorldRay<Real>& ray, const Inside& inside, Arriving light) {
    ++counts_.shadow;
    const Boundary met = next_boundary(of_.world_, ray, inside, counts_.work);
    if (met.instance != light.emitter || met.leaves || met.is_within || met.is_lost) return;
    light.light.array() *= left_after(medium(inside), met.t).array();
    add(light);
  }

  void add(const Arriving& arriving) {
    Path& path = paths_[arriving.path];
    gather(path, path.throughput.cwiseProduct(arriving.light), path.depth + 1);
  }

  /// Draws the direction in which the path goes on, or ends it.
  void scatter(Path& path, const Point& point) {
    const std::array<double, 2> u = path.sampler.next();
    const double which = path.sampler.next()[0];
    const auto sample = point.bsdf->sample(point.shading, {u, which});
    path.goes_on = sample && (sample->weight.array() > 0).any();
    if (!path.goes_on) return;
    const bool goes_through = (sample->w_in.z() > 0) != (point.shading.w_out.z() > 0);
    if (goes_through) {
      const double eta = point.shading.eta_below / point.shading.eta_above;
      path.gathered *= sample->w_in.z() > 0 ? 1 / (eta * eta) : eta * eta;
    }
    path.throughput = path.throughput.cwiseProduct(sample->weight);
    const Vec3<double> direction = unit(point.frame.to_world(sample->w_in));
    if (!point.is_on_side(sample->w_in, direction)) {
      path.goes_on = false;
      return;
    }
    path.ray = point.ray(sample->w_in, direction);
    path.inside = point.inside(sample->w_in);
    path.left = point.instance;
    path.from = point.position;
    path.is_sharp = sample->is_sharp;
    path.only_sharp = path.only_sharp && sample->is_sharp;
    path.is_straight = true;
    path.pdf = sample->pdf;
    ++path.depth;
    ++(sample->is_sharp ? counts_.mirrored : counts_.scattered);
    if (path.depth < sure_depth) return;
    const double chance = std::min(path.throughput.maxCoeff() * path.gathered, 1.0);
    if (chance >= 1) return;
    path.goes_on = path.sampler.next()[0] < chance;
    path.throughput /= chance;
  }

  const PathTransport& of_;
  std::span<TracedRay> rays_;
  RayCounts& counts_;
  const Medium air_;
  std::array<Path, most_in_ray_group> paths_;
  std::array<Boundary, most_in_ray_group> boundaries_;
  std::array<std::optional<Point>, most_in_ray_group> points_;
};

PathTransport::PathTransport(const Scene& scene, const RenderWorld& world,
                             const IntegratorOptions& options)
    : world_(world),
      options_(options),
      surfaces_(scene),
      emitters_(world, surfaces_.radiances()),
      lights_(scene.lights),
      background_(scene.background.zenith, scene.background.nadir),
      background_is_sky_(scene.background_is_sky) {
  if (!surfaces_.has_sheets()) return;
  for (std::uint32_t i = 0; i < world.instances().size(); ++i)
    is_flat_sheet_.push_back(surfaces_.of(i).is_sheet && is_flat(world, i));
}

void PathTransport::trace(std::span<TracedRay> rays, RayCounts& counts) const {
  counts.camera += rays.size();
  for (std::size_t i = 0; i < rays.size(); i += most_in_ray_group)
    Packet(*this, rays.subspan(i, std::min<std::size_t>(most_in_ray_group, rays.size() - i)),
           counts)
        .run();
}

}  // namespace minkray
