// SPDX-License-Identifier: MIT
#include "renderer/paths/inside.h"

#include <algorithm>

#include "core/bvh/traverse.h"

namespace minkray {
namespace {

/// A ray that leaves a surface starts this far above it, in units of rounding (machine epsilon
/// times the largest coordinate that went into the hit point). Hit points are off by a few dozen
/// units (docs/decisions/path-tracing.md); the shape itself is left out of the cast, so this
/// only keeps other shapes with a face in the same plane from shading each other.
constexpr double surface_offset = 256;

/// Finds where the ray leaves a body that it is in.
Boundary exit_of(const World& world, const WorldRay& ray, std::uint32_t body, QueryCounts& counts) {
  const Instances& instances = world.instances();
  const Ray<double> seen = instances.seen_by(body, ray.ray, ray.time);
  Boundary exit;
  exit.instance = body;
  exit.leaves = true;
  ++counts.casts;
  if (instances.is_half_space(body)) {
    for (const auto& half_space : instances.half_spaces()) {
      if (half_space.instance != body) continue;
      const Vec3<double>& normal = half_space.in_world.normal;
      const double rise = normal.dot(seen.direction);
      const double depth = half_space.in_world.offset - normal.dot(seen.origin);
      exit.normal = instances.turned(body, normal, ray.time);
      exit.t =
          rise > 0 ? std::max(depth / rise, double(0)) : std::numeric_limits<double>::infinity();
    }
    return exit;
  }
  if (instances.is_mesh(body)) {
    PartCounts parts;
    const MeshCast next =
        cast_ray(instances.mesh_of(body), seen, std::numeric_limits<double>::infinity(), true,
                 instances.loss_of_seen_by(body, ray.ray), parts);
    counts.add_parts(parts);
    exit.is_lost = !next.cast.found();  // the mesh is not closed
    exit.t = next.cast.t();
    exit.part = next.part;
    exit.normal = instances.turned(body, -next.cast.normal, ray.time);
    return exit;
  }
  const CastResult<double> cast =
      cast_exit(instances.at_seen_by(body, ray.ray), seen, world.options());
  counts.iterations += static_cast<std::uint64_t>(cast.iterations);
  counts.supports += static_cast<std::uint64_t>(cast.supports);
  ++counts.by_path[static_cast<std::size_t>(cast.path)];
  if (cast.status == Status::hit) {
    exit.t = std::max(cast.t(), double(0));
    exit.normal = cast.normal;
  } else if (cast.status == Status::miss) {
    // On the surface and going along it: by rounding, out of it at once.
    exit.normal = cast.normal.dot(seen.direction) > 0 && cast.normal.allFinite()
                      ? unit<double>(cast.normal)
                      : unit<double>(seen.direction);
  } else {
    ++counts.exhausted;
    exit.is_lost = true;
  }
  exit.normal = instances.turned(body, exit.normal, ray.time);
  return exit;
}

/// The closest hit but of some instances.
WorldHit closest_but(const World& world, const WorldRay& ray, std::span<const std::uint32_t> but,
                     QueryCounts& counts) {
  const Instances& instances = world.instances();
  WorldHit closest;
  closest.cast.status = Status::miss;
  const auto is_left_out = [&](std::uint32_t instance) {
    return ray.passes(instances, instance) ||
           std::find(but.begin(), but.end(), instance) != but.end();
  };
  const auto meet = [&](std::uint32_t instance, const CastResult<double>& cast,
                        std::uint32_t part = no_part) {
    counts.add_cast(cast);
    if (!cast.found() || !closest.yields_to(instance, cast.t())) return false;
    closest = {instance, instances.turned(instance, cast, ray.time), part};
    return true;
  };
  for (const auto& half_space : instances.half_spaces())
    if (!is_left_out(half_space.instance))
      meet(
          half_space.instance,
          cast_ray(half_space.in_world, instances.seen_by(half_space.instance, ray.ray, ray.time)));
  for (const PosedMesh& mesh : instances.meshes()) {
    if (is_left_out(mesh.instance)) continue;
    PartCounts parts;
    const double most =
        closest.found() ? closest.cast.t() : std::numeric_limits<double>::infinity();
    const MeshCast cast = cast_ray(mesh, instances.seen_by(mesh.instance, ray.ray, ray.time), most,
                                   false, instances.loss_of_seen_by(mesh.instance, ray.ray), parts);
    counts.add_parts(parts);
    meet(mesh.instance, cast.cast, cast.part);
  }
  SlabRay slabs(ray.ray);
  if (closest.found()) slabs.numbers.t_max = slabs.limit(closest.cast.t());
  counts.nodes += traverse(world.bvh(), slabs, [&](std::uint32_t instance) {
    if (is_left_out(instance)) return false;
    if (meet(instance, cast_ray(instances.at_seen_by(instance, ray.ray),
                                instances.seen_by(instance, ray.ray, ray.time), world.options())))
      slabs.numbers.t_max = slabs.limit(closest.cast.t());
    return false;
  });
  return closest;
}

}  // namespace

bool Inside::holds(std::uint32_t body) const {
  const auto all = bodies();
  return std::find(all.begin(), all.end(), body) != all.end();
}

bool Inside::enter(std::uint32_t body) {
  if (count_ == most) return false;
  bodies_[count_++] = body;
  return true;
}

void Inside::leave(std::uint32_t body) {
  const auto end = bodies_.begin() + static_cast<std::ptrdiff_t>(count_);
  count_ = static_cast<std::size_t>(std::remove(bodies_.begin(), end, body) - bodies_.begin());
}

Boundary boundary_of(const WorldHit& hit) {
  Boundary boundary;
  if (!hit.found()) return boundary;
  boundary.instance = hit.instance;
  boundary.part = hit.part;
  boundary.is_within = hit.cast.status == Status::inside;
  boundary.t = hit.cast.t();
  boundary.normal = hit.cast.normal;
  return boundary;
}

double rounding_at(const World& world, std::uint32_t instance, const Vec3<double>& point,
                   double t) {
  const double largest =
      std::max({point.cwiseAbs().maxCoeff(), t, world.instances().half_extent(instance)});
  return surface_offset * tolerance::epsilon<double> * largest;
}

double length_within(const World& world, const Ray<double>& ray, const WorldHit& hit) {
  if (!hit.found()) return 0;
  QueryCounts counts;
  const Boundary exit = exit_of(world, {ray}, hit.instance, counts);
  const double entry = hit.cast.status == Status::hit ? hit.cast.t() : double(0);
  return exit.is_lost ? double(0) : std::max(exit.t - entry, double(0));
}

Boundary next_boundary(const World& world, const WorldRay& ray, const Inside& inside,
                       QueryCounts& counts) {
  Boundary next;
  next.t = ray.ray.t_max;
  for (const std::uint32_t body : inside.bodies()) {
    const Boundary exit = exit_of(world, ray, body, counts);
    if (exit.is_lost) return exit;
    if (exit.t < next.t) next = exit;
  }
  WorldRay ahead = ray;
  if (next.leaves)
    ahead.ray.t_max = next.t + rounding_at(world, next.instance, ray.ray.at(next.t), next.t);
  const WorldHit entered = closest_but(world, ahead, inside.bodies(), counts);
  if (entered.found()) return boundary_of(entered);
  return next;
}

}  // namespace minkray
