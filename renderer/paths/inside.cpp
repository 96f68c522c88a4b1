// SPDX-License-Identifier: MIT
#include "renderer/paths/inside.h"

#include <algorithm>
#include <vector>

#include "core/bvh/traverse.h"
#include "core/cast/packet_cast.h"

namespace minkray {
namespace {

/// A ray that leaves a surface starts this far above it, in units of rounding (machine epsilon
/// times the largest coordinate that went into the hit point). Hit points are off by a few dozen
/// units (docs/decisions/path-tracing.md); the shape itself is left out of the cast, so this
/// only keeps other shapes with a face in the same plane from shading each other.
constexpr double surface_offset = 256;

/// Exit by the result of cast_exit at a body with a shape.
Boundary exit_by(const World& world, const WorldRay& ray, std::uint32_t body,
                 const CastResult<double>& cast, QueryCounts& counts) {
  const Instances& instances = world.instances();
  const Ray<double> seen = instances.seen_by(body, ray.ray, ray.time);
  Boundary exit;
  exit.instance = body;
  exit.leaves = true;
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
    const PartCast next =
        cast_ray(instances.mesh_of(body), seen, std::numeric_limits<double>::infinity(), true,
                 instances.loss_of_seen_by(body, ray.ray), parts);
    counts.add_parts(parts);
    exit.is_lost = !next.cast.found();  // the mesh is not closed
    exit.t = next.cast.t();
    exit.part = next.part;
    exit.normal = instances.turned(body, -next.cast.normal, ray.time);
    return exit;
  }
  if (instances.is_compound(body)) {
    const PartCast last =
        cast_last_exit(instances.compound_of(body), seen, world.options(), counts);
    return exit_by(world, ray, body, last.cast, counts);
  }
  return exit_by(world, ray, body,
                 cast_exit(instances.at_seen_by(body, ray.ray), seen, world.options()), counts);
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
  for (const PosedCompound& compound : instances.compounds()) {
    if (is_left_out(compound.instance)) continue;
    const PartCast cast = cast_ray(
        compound, instances.seen_by(compound.instance, ray.ray, ray.time),
        closest.found() ? closest.cast.t() : std::numeric_limits<double>::infinity(), false,
        instances.loss_of_seen_by(compound.instance, ray.ray), world.options(), counts);
    meet(compound.instance, cast.cast, cast.part);
  }
  for (const PosedMesh& mesh : instances.meshes()) {
    if (is_left_out(mesh.instance)) continue;
    PartCounts parts;
    const double most =
        closest.found() ? closest.cast.t() : std::numeric_limits<double>::infinity();
    const PartCast cast = cast_ray(mesh, instances.seen_by(mesh.instance, ray.ray, ray.time), most,
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

/// First of the exits of a ray from the bodies around it, and of the bodies that it enters.
/// exit_at(k) is the exit from the body of that place.
template <class ExitAt, class HalfExtent>
Boundary nearer_of(const World& world, const WorldRay& ray, const Inside& inside,
                   const ExitAt& exit_at, const HalfExtent& half_extent, QueryCounts& counts) {
  Boundary next;
  next.t = ray.ray.t_max;
  for (std::size_t k = 0; k < inside.bodies().size(); ++k) {
    const Boundary exit = exit_at(k);
    if (exit.is_lost) return exit;
    if (exit.t < next.t) next = exit;
  }
  WorldRay ahead = ray;
  if (next.leaves)
    ahead.ray.t_max = next.t + rounding_at(half_extent(next.instance), ray.ray.at(next.t), next.t);
  const WorldHit entered = closest_but(world, ahead, inside.bodies(), counts);
  if (entered.found()) return boundary_of(entered);
  return next;
}

/// A body around a ray, and the place of its exit in a list.
struct RayWithin {
  std::uint32_t body, ray, place;
};

/// True if exits from the body are cast in packets.
bool goes_together(const World& world, std::uint32_t body) {
  const Instances& instances = world.instances();
  if (instances.move() || !instances.has_shape(body)) return false;
  const CastOptions &options = world.options(), defaults;
  if (options.solver != defaults.solver || options.eps_tol != defaults.eps_tol ||
      options.max_iterations != defaults.max_iterations || options.v0 != defaults.v0)
    return false;
  const ShapeDefinition& definition = *instances.body_of(body).definition;
  return definition.form().kind == FormKind::none && definition.has_packets();
}

/// Finds the exits of up to a packet of rays from one body.
void find_exits(const World& world, std::span<const WorldRay> rays,
                std::span<const RayWithin> within, std::span<Boundary> exits, QueryCounts& counts) {
  const std::uint32_t body = within[0].body;
  if (within.size() == 1) {
    exits[within[0].place] = exit_of(world, rays[within[0].ray], body, counts);
    return;
  }
  RayPacket packet;
  for (int lane = 0; lane < packet_lanes; ++lane)
    packet.set(lane,
               rays[within[std::min(static_cast<std::size_t>(lane), within.size() - 1)].ray].ray);
  CastPacket casts;
  cast_exit_packet(world.instances().at(body), packet, (LaneBits(1) << within.size()) - 1, casts);
  for (std::size_t i = 0; i < within.size(); ++i) {
    ++counts.casts;
    exits[within[i].place] =
        exit_by(world, rays[within[i].ray], body, casts.result(static_cast<int>(i)), counts);
  }
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

double rounding_at(double half_extent, const Vec3<double>& point, double t) {
  const double largest = std::max({point.cwiseAbs().maxCoeff(), t, half_extent});
  return surface_offset * tolerance::epsilon<double> * largest;
}

double rounding_at(const World& world, std::uint32_t instance, const Vec3<double>& point,
                   double t) {
  return rounding_at(world.instances().half_extent(instance), point, t);
}

void HalfExtents::begin(const World& world) {
  world_ = &world;
  kept_.fill({});
}

double HalfExtents::of(std::uint32_t instance) {
  Kept& kept = kept_[instance % kept_.size()];
  if (kept.instance != instance) kept = {instance, world_->instances().half_extent(instance)};
  return kept.half_extent;
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
  const auto exit_at = [&](std::size_t k) {
    return exit_of(world, ray, inside.bodies()[k], counts);
  };
  const auto half_extent = [&](std::uint32_t body) { return world.instances().half_extent(body); };
  return nearer_of(world, ray, inside, exit_at, half_extent, counts);
}

void next_boundaries(const World& world, std::span<const WorldRay> rays,
                     std::span<const Inside* const> insides, std::span<Boundary> nexts,
                     HalfExtents& half_extents, QueryCounts& counts) {
  std::vector<RayWithin> all;
  std::vector<std::size_t> firsts;
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    firsts.push_back(all.size());
    for (const std::uint32_t body : insides[i]->bodies())
      all.push_back({body, i, static_cast<std::uint32_t>(all.size())});
  }
  std::vector<Boundary> exits(all.size());
  std::sort(all.begin(), all.end(), [](const RayWithin& a, const RayWithin& b) {
    return a.body != b.body ? a.body < b.body : a.place < b.place;
  });
  for (std::size_t from = 0, end; from < all.size(); from = end) {
    const std::uint32_t body = all[from].body;
    const std::size_t most = goes_together(world, body) ? packet_lanes : 1;
    for (end = from + 1; end < all.size() && end < from + most && all[end].body == body;) ++end;
    find_exits(world, rays, std::span(all).subspan(from, end - from), exits, counts);
  }
  const auto half_extent = [&](std::uint32_t body) { return half_extents.of(body); };
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto exit_at = [&](std::size_t k) { return exits[firsts[i] + k]; };
    nexts[i] = nearer_of(world, rays[i], *insides[i], exit_at, half_extent, counts);
  }
}

}  // namespace minkray
