// SPDX-License-Identifier: MIT
// All points where a ray enters or leaves the instances of a world.
#include <algorithm>

#include "core/bvh/traverse.h"
#include "core/cast/cast.h"
#include "core/math/outward_sum.h"
#include "core/world/world.h"

namespace minkray {
namespace {

WorldCrossing crossing_of(const WorldRay& ray, std::uint32_t instance,
                          const CastResult<double>& cast, bool leaves) {
  const Vec3<double>&o = ray.ray.origin, &d = ray.ray.direction;
  return {instance,
          no_part,
          cast.t(),
          std::max(sum_or_less(cast.t_base, cast.offset_lo), 0.0),
          sum_or_more(cast.t_base, cast.offset_hi),
          (o + cast.t_base * d) + cast.t_offset * d,
          cast.normal,
          leaves};
}

/// Result for a ray that leaves the shape at the ray's origin.
CastResult<double> at_origin(const Vec3<double>& normal) {
  return {Status::hit, Path::filter, 0, 0, 0, 0, normal};
}

/// Makes t of the crossings of one instance, or part, ascend, in spite of rounding.
void put_in_order(std::vector<WorldCrossing>& crossings, std::size_t first) {
  for (std::size_t i = first + 1; i < crossings.size(); ++i) {
    WorldCrossing& one = crossings[i];
    one.t = std::max(one.t, crossings[i - 1].t);
    one.t_hi = std::max(one.t_hi, one.t);
  }
}

}  // namespace

void World::add_shape_crossings(const WorldRay& ray, std::uint32_t instance,
                                std::vector<WorldCrossing>& to, QueryCounts& counts) const {
  if (ray.passes(instances_, instance)) return;
  const ShapeCrossings found =
      crossings_of(instances_.at_seen_by(instance, ray.ray), no_part,
                   instances_.seen_by(instance, ray.ray, ray.time), options_, counts);
  const std::size_t first = to.size();
  for (int i = 0; i < found.count; ++i) {
    const auto& [at, leaves] = found.at[i];
    to.push_back(
        crossing_of(ray, instance, instances_.turned(instance, at.cast, ray.time), leaves));
  }
  put_in_order(to, first);
}

void World::add_compound_crossings(const WorldRay& ray, const PosedCompound& compound,
                                   std::vector<WorldCrossing>& to, QueryCounts& counts) const {
  const std::uint32_t instance = compound.instance;
  if (ray.passes(instances_, instance)) return;
  std::vector<PartCrossing> found;
  add_crossings(compound, instances_.seen_by(instance, ray.ray, ray.time),
                instances_.loss_of_seen_by(instance, ray.ray), options_, counts, found);
  std::size_t first = to.size();  // of the part
  for (const PartCrossing& one : found) {
    to.push_back(
        crossing_of(ray, instance, instances_.turned(instance, one.at.cast, ray.time), one.leaves));
    to.back().part = one.at.part;
    if (to[first].part != one.at.part) first = to.size() - 1;
    put_in_order(to, first);
  }
}

void World::add_shapeless_crossings(const WorldRay& ray, std::vector<WorldCrossing>& to,
                                    QueryCounts& counts) const {
  for (const auto& [instance, at_rest, in_world] : instances_.half_spaces()) {
    if (ray.passes(instances_, instance)) continue;
    ++counts.casts;
    const Ray<double> seen = instances_.seen_by(instance, ray.ray, ray.time);
    CastResult<double> result = cast_ray(in_world, seen);
    const bool leaves = result.status == Status::inside;
    if (leaves) {
      if (!(in_world.normal.dot(seen.direction) > 0)) continue;
      HalfSpaceBody<double> outside = in_world;
      outside.normal = -in_world.normal;
      outside.offset = -in_world.offset;
      result = cast_ray(outside, seen);
      result.normal = in_world.normal;
      if (result.status == Status::inside) result = at_origin(in_world.normal);
    }
    counts.exhausted += result.status == Status::exhausted ? 1 : 0;
    if (result.status == Status::hit)
      to.push_back(
          crossing_of(ray, instance, instances_.turned(instance, result, ray.time), leaves));
  }
  std::vector<PartCrossing> of_mesh;
  auto on_mesh = [&](std::uint32_t index) {
    const PosedMesh& mesh = instances_.meshes()[index];
    if (ray.passes(instances_, mesh.instance)) return false;
    of_mesh.clear();
    const Ray<double> seen = instances_.seen_by(mesh.instance, ray.ray, ray.time);
    if (!add_crossings(mesh, seen, instances_.loss_of_seen_by(mesh.instance, ray.ray), of_mesh))
      ++counts.exhausted;
    const std::size_t first = to.size();
    for (const PartCrossing& one : of_mesh) {
      to.push_back(crossing_of(
          ray, mesh.instance, instances_.turned(mesh.instance, one.at.cast, ray.time), one.leaves));
      to.back().part = one.at.part;
    }
    counts.add_filtered(of_mesh.size());
    put_in_order(to, first);
    return false;
  };
  if (instances_.meshes().size() == 1)
    on_mesh(0);
  else
    counts.nodes += traverse(mesh_boxes_, SlabRay(ray.ray), on_mesh);
  if (instances_.compounds().empty()) return;
  counts.nodes += traverse(compound_boxes_, SlabRay(ray.ray), [&](std::uint32_t index) {
    add_compound_crossings(ray, instances_.compounds()[index], to, counts);
    return false;
  });
}

void World::all_hits(const WorldRay& ray, std::vector<WorldCrossing>& to,
                     QueryCounts& counts) const {
  const auto first = static_cast<std::ptrdiff_t>(to.size());
  add_shapeless_crossings(ray, to, counts);
  auto on_instance = [&](std::uint32_t instance) {
    add_shape_crossings(ray, instance, to, counts);
    auto one = std::ranges::lower_bound(repeated_, instance, {}, &RepeatedInstance::same_as);
    for (; one != repeated_.end() && one->same_as == instance; ++one)
      add_shape_crossings(ray, one->number, to, counts);
    return false;
  };
  counts.nodes += traverse(bvh_, SlabRay(ray.ray), on_instance, prefetching());
  // The crossings of one instance at equal t keep their order.
  std::stable_sort(to.begin() + first, to.end(),
                   [](const WorldCrossing& a, const WorldCrossing& b) {
                     return a.t < b.t || (a.t == b.t && a.instance < b.instance);
                   });
}

}  // namespace minkray
