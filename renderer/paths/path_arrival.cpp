// SPDX-License-Identifier: MIT
// Ends of the rays of paths: the light found there, and the point where the path scatters next.
#include <limits>

#include "renderer/paths/path_wave.h"

namespace minkray {
namespace {

/// A path goes through no more boundaries that do not count: of bodies within others.
constexpr int most_passages = 256;

}  // namespace

const Medium& PathTransport::Wave::medium(const Inside& inside, std::uint32_t* which) const {
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

Colour PathTransport::Wave::left_after(const Medium& medium, double length) {
  if (medium.absorption.isZero(0)) return Colour::Ones();
  return (-medium.absorption * length).array().exp();
}

void PathTransport::Wave::arrive(std::size_t i) {
  Path& path = paths_[i];
  const Boundary& at = boundaries_[i];
  const bool is_first = path.depth == 0 && path.passages == 0;
  if (is_first) rays_[i].met = at.instance != no_instance;
  if (at.is_lost || at.instance == no_instance) {
    if (!at.is_lost && path.inside.none()) gather(path, off_surface(path), path.depth);
    path.goes_on = false;
    return;
  }
  const PreparedMaterial& material = of_.surfaces_.of(at.instance, at.part);
  if (at.is_within) {
    counts_.from_inside += is_first && !material.bsdf->lets_through() ? 1 : 0;
    pass(path, material.bsdf->lets_through() && path.inside.enter(at.instance));
    return;
  }
  path.cone = path.cone.at(at.t);
  std::uint32_t holder = no_instance;
  const Medium& before = medium(path.inside, &holder);
  if (holder != no_instance) path.throughput.array() *= left_after(before, at.t).array();
  if (!at.leaves) add_emission(path, at, material);

  Inside beyond = path.inside;
  Shading shading;
  if (material.bsdf->lets_through() && !of_.is_flat_sheet(at.instance)) {
    const bool has_room = at.leaves || beyond.enter(at.instance);
    if (at.leaves) beyond.leave(at.instance);
    const bool counts = at.leaves
                            ? holder == at.instance
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
  const Vec3<double> position = path.ray.at(at.t);
  TexturePoint place;
  const SurfaceHit hit{at.instance, at.part, at.normal};
  if (of_.surfaces_.has_textures())
    place =
        of_.surfaces_.place(of_.world_, hit, position, path.time, path.ray.direction, path.cone);
  const auto in_world = [&](const Vec3<double>& direction) {
    return of_.world_.instances().turned(at.instance, direction, path.time);
  };
  const auto frame_of = [&](const Vec3<double>& normal) {
    return material.bsdf->has_grain() ? Frame(normal, in_world(of_.surfaces_.axis(at.instance)))
                                      : Frame(normal);
  };
  SmoothPoint smooth{at.normal};
  if (of_.surfaces_.looks().has_normals(at.instance)) {
    smooth = of_.surfaces_.looks().smooth(of_.world_, hit, position, path.time);
    smooth.normal = seen_normal(smooth.normal, path.ray.direction, at.leaves);
    // Light that goes through keeps to the triangles.
    if (material.bsdf->lets_through()) smooth = {smooth.normal};
  }
  Frame frame = frame_of(smooth.normal);
  if (material.relief.any()) {
    const Frame bent = frame_of(in_world(of_.surfaces_.relief_normal_at(at.instance, place)));
    // A surface seen from behind its bent normal keeps its own normal.
    if ((bent.z.dot(path.ray.direction) > 0) == at.leaves) frame = bent;
  }
  shading.w_out = frame.to_local(-path.ray.direction);
  // A grazing normal may be rounded to the far side.
  constexpr double least = std::numeric_limits<double>::epsilon();
  double& z = shading.w_out.z();
  z = at.leaves ? std::min(z, -least) : std::max(z, least);
  points_[i].emplace(Point{position, rounding_at(half_extents_.of(at.instance), position, at.t),
                           at.normal, smooth.lift, smooth.is_curved ? smooth.normal : at.normal,
                           frame, shading, material.bsdf.get(), at.instance,
                           at.leaves ? beyond : path.inside, at.leaves ? path.inside : beyond,
                           place, frame.z != at.normal});
  if (of_.surfaces_.has_textures()) points_[i]->shading.place = &points_[i]->place;
}

void PathTransport::Wave::gather(Path& path, const Colour& light, int depth) const {
  if (depth <= 1) path.direct += light;
  const double most = of_.options_.clamp, brightest = light.maxCoeff();
  if (most > 0 && depth > 1 && !path.only_sharp && brightest > most)
    path.radiance += most / brightest * light;
  else
    path.radiance += light;
}

void PathTransport::Wave::pass(Path& path, bool can) const {
  path.is_straight = false;
  path.goes_on = can && ++path.passages < most_passages;
}

Colour PathTransport::Wave::off_surface(const Path& path) {
  counts_.background += path.depth == 0 ? 1 : 0;
  const bool sees_background =
      path.only_sharp && (path.depth == 0 || !of_.lights_.has_environment());
  if (sees_background && !of_.background_is_sky_)
    return path.throughput.cwiseProduct(of_.background_.eval(path.ray.direction));
  Colour light = Colour::Zero();
  for (const auto& sky : of_.lights_.skies()) {
    const Colour radiance = sky->eval(path.ray.direction);
    const bool was_asked = sky->is_asked() && !path.is_sharp && path.is_straight;
    const double part = was_asked ? share(path.pdf, sky->pdf(path.from, path.ray.direction)) : 1.0;
    light += part * radiance;
  }
  return path.throughput.cwiseProduct(light);
}

void PathTransport::Wave::add_emission(Path& path, const Boundary& at,
                                       const PreparedMaterial& material) const {
  if (!(material.radiance.maxCoeff() > 0)) return;
  double part = 1;
  if (!path.is_sharp && path.is_straight)
    part = share(path.pdf, of_.emitters_.pdf(path.from, path.time, path.ray.direction,
                                             {at.instance, at.part, at.t}));
  gather(path, part * path.throughput.cwiseProduct(material.radiance), path.depth);
}

}  // namespace minkray
