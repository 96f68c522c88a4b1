// SPDX-License-Identifier: MIT
#include "renderer/paths/path_transport.h"

#include <cmath>
#include <memory>
#include <utility>

#include "renderer/paths/path_wave.h"

namespace minkray {
namespace {

/// Paths are not ended by chance before they were scattered so often; what is seen through glass or
/// in mirrors, a little later.
constexpr int sure_depth = 3, sure_sharp_depth = 4;

/// A body is one sheet if it is so thin, over its largest extent.
constexpr double sheet_thickness = 1e-6;

bool is_flat(const World& world, std::uint32_t instance) {
  if (!world.instances().has_shape(instance)) return false;
  const Vec3<double> half = world.instances().at(instance).definition().inner_half_extents();
  return half.minCoeff() <= sheet_thickness * half.maxCoeff();
}

}  // namespace

PathTransport::Wave::Wave(const PathTransport& of, std::span<TracedRay> rays, RayCounts& counts,
                          WaveMemory& memory)
    : of_(of),
      rays_(rays),
      counts_(counts),
      paths_(memory.paths),
      going_on_(memory.going_on),
      boundaries_(memory.boundaries),
      points_(memory.points),
      scattering_(memory.scattering),
      asked_(memory.asked),
      whose_(memory.whose),
      asked_within_(memory.asked_within),
      whose_within_(memory.whose_within),
      insides_(memory.insides),
      nexts_(memory.nexts),
      hits_(memory.hits),
      blocked_(memory.blocked),
      shadows_(memory.shadows),
      half_extents_(memory.half_extents) {
  half_extents_.begin(of.world_);
  paths_.clear();
  paths_.resize(rays.size());
  going_on_.resize(rays.size());
  boundaries_.resize(rays.size());
  points_.resize(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Path& path = paths_[i];
    path.ray = rays[i].ray;
    path.sampler = rays[i].sampler;
    path.time = rays[i].time;
    path.left = rays[i].left;
    path.cone = rays[i].cone;
    going_on_[i] = i;
  }
}

void PathTransport::Wave::run() {
  while (!going_on_.empty()) {
    find_boundaries();
    scattering_.clear();
    for (const std::size_t i : going_on_) {
      points_[i].reset();
      arrive(i);
      if (points_[i]) scattering_.push_back(i);
    }
    for (std::size_t light = 0; light < of_.lights_.count(); ++light) ask_light(light);
    for (const auto& sky : of_.lights_.skies()) ask_sky(*sky);
    if (!of_.emitters_.none()) ask_emitters();
    for (const std::size_t i : scattering_) scatter(paths_[i], *points_[i]);
    std::erase_if(going_on_, [&](std::size_t i) { return !paths_[i].goes_on; });
  }
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    rays_[i].radiance = paths_[i].radiance;
    rays_[i].direct = paths_[i].direct;
  }
}

void PathTransport::Wave::find_boundaries() {
  asked_.clear();
  whose_.clear();
  asked_within_.clear();
  whose_within_.clear();
  insides_.clear();
  for (const std::size_t i : going_on_) {
    const Path& path = paths_[i];
    const WorldRay ray{path.ray, path.left, path.time, kinds_of(kind(path))};
    if (path.inside.none()) {
      asked_.push_back(ray);
      whose_.push_back(i);
    } else {
      asked_within_.push_back(ray);
      whose_within_.push_back(i);
      insides_.push_back(&path.inside);
    }
  }
  nexts_.resize(asked_within_.size());
  next_boundaries(of_.world_, asked_within_, insides_, nexts_, half_extents_, counts_.work);
  for (std::size_t k = 0; k < whose_within_.size(); ++k) boundaries_[whose_within_[k]] = nexts_[k];
  const auto kind_of = [&](std::size_t k) { return kind(paths_[whose_[k]]); };
  of_.casts_.find_hits(kind_of, asked_, hits_, counts_.work);
  for (std::size_t k = 0; k < whose_.size(); ++k) boundaries_[whose_[k]] = boundary_of(hits_[k]);
}

void PathTransport::Wave::scatter(Path& path, const Point& point) {
  const std::array<double, 2> u = path.sampler.next();
  const double which = path.sampler.next()[0];
  const auto sample = point.bsdf->sample(point.shading, {u, which});
  path.goes_on = sample && (sample->weight.array() > 0).any();
  if (!path.goes_on) return;
  const bool goes_through = (sample->w_in.z() > 0) != (point.shading.w_out.z() > 0);
  if (goes_through) {
    const double eta = point.shading.eta_below / point.shading.eta_above;
    path.gathered *= sample->w_in.z() > 0 ? 1 / (eta * eta) : eta * eta;
    path.cone = path.cone.refracted(sample->w_in.z() > 0 ? 1 / eta : eta);
  }
  path.throughput = path.throughput.cwiseProduct(sample->weight);
  const Vec3<double> direction = unit(point.frame.to_world(sample->w_in));
  if (!point.is_on_side(sample->w_in, direction, sample->is_sharp)) {
    path.goes_on = false;
    return;
  }
  path.ray = point.ray(sample->w_in, direction, sample->is_sharp);
  path.inside = point.inside(sample->w_in);
  path.left = point.instance;
  path.from = point.lit_at();
  path.is_sharp = sample->is_sharp;
  path.only_sharp = path.only_sharp && sample->is_sharp;
  path.is_straight = true;
  path.pdf = sample->pdf;
  ++path.depth;
  ++(sample->is_sharp ? counts_.mirrored : counts_.scattered);
  if (path.depth < (path.only_sharp ? sure_sharp_depth : sure_depth)) return;
  // Uses the root: ending a path saves its rest, but makes the surviving paths brighter and rarer.
  const double chance = std::sqrt(std::min(path.throughput.maxCoeff() * path.gathered, 1.0));
  if (chance >= 1) return;
  path.goes_on = path.sampler.next()[0] < chance;
  path.throughput /= chance;
}

Emitters::RadianceOfPart PathTransport::radiance_of_part(const SceneSurfaces& surfaces) {
  if (!surfaces.has_lamps()) return {};
  return [&](std::uint32_t instance, std::uint32_t part) {
    return surfaces.of(instance, part).radiance;
  };
}

PathTransport::PathTransport(const Scene& scene, const World& world,
                             const IntegratorOptions& options)
    : world_(world),
      casts_(world, options),
      options_(options),
      surfaces_(scene),
      emitters_(world, surfaces_.radiances(), radiance_of_part(surfaces_)),
      lights_(scene.lights),
      background_(scene.background.zenith, scene.background.nadir),
      background_is_sky_(scene.background_is_sky) {
  if (!surfaces_.has_sheets()) return;
  for (std::uint32_t i = 0; i < world.instances().size(); ++i)
    is_flat_sheet_.push_back(surfaces_.of(i).is_sheet && is_flat(world, i));
}

void PathTransport::trace(std::span<TracedRay> rays, RayCounts& counts) const {
  counts.camera += rays.size();
  std::unique_ptr<WaveMemory> memory;
  {
    const std::lock_guard lock(spare_lock_);
    if (!spare_.empty()) {
      memory = std::move(spare_.back());
      spare_.pop_back();
    }
  }
  if (!memory) memory = std::make_unique<WaveMemory>();
  Wave(*this, rays, counts, *memory).run();
  const std::lock_guard lock(spare_lock_);
  spare_.push_back(std::move(memory));
}

PathTransport::~PathTransport() = default;

}  // namespace minkray
