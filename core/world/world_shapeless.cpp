// SPDX-License-Identifier: MIT
// Casts at half-spaces, meshes and compounds. A world has few of them; they come before shapes, as
// their hits limit the rays.
#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "core/bvh/box_rounds.h"
#include "core/bvh/group_walk.h"
#include "core/bvh/stream.h"
#include "core/world/posed_mesh_rays.h"
#include "core/world/world.h"

namespace minkray {
namespace {

/// Least number of rays to trace together; fewer are faster one by one.
constexpr std::size_t least_together = 4;

/// True if rays in different directions are to be traced together. With more meshes and few rays of
/// each, single rays are as fast.
bool are_worth_rounds(std::size_t rays, std::size_t meshes) {
  constexpr std::size_t most_meshes = 4, least_of_mesh = 32;
  return meshes <= most_meshes || rays >= least_of_mesh * meshes;
}

}  // namespace

bool World::closer_half_space(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const {
  bool found = false;
  for (const auto& [instance, at_rest, in_world] : instances_.half_spaces()) {
    if (ray.passes(instances_, instance)) continue;
    ++counts.casts;
    const CastResult<double> result =
        cast_ray(in_world, instances_.seen_by(instance, ray.ray, ray.time));
    counts.exhausted += result.status == Status::exhausted ? 1 : 0;
    if (!result.found() || !closest.yields_to(instance, result.t())) continue;
    closest = {instance, instances_.turned(instance, result, ray.time)};
    found = true;
  }
  return found;
}

bool World::closer_compound(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const {
  if (instances_.compounds().empty()) return false;
  bool found = false;
  SlabRay slabs(ray.ray);
  if (closest.found()) slabs.numbers.t_max = slabs.limit(closest.cast.t());
  counts.nodes += traverse(compound_boxes_, slabs, [&](std::uint32_t index) {
    const PosedCompound& compound = instances_.compounds()[index];
    const std::uint32_t instance = compound.instance;
    if (!instances_.is_shown_to(instance, ray.kinds)) return false;
    const double most =
        closest.found() ? closest.cast.t() : std::numeric_limits<double>::infinity();
    const auto [cast, part] = cast_ray(
        compound, instances_.seen_by(instance, ray.ray, ray.time), most, instance == ray.skip,
        instances_.loss_of_seen_by(instance, ray.ray), options_, counts);
    if (!cast.found() || !closest.yields_to(instance, cast.t())) return false;
    closest = {instance, instances_.turned(instance, cast, ray.time), part};
    slabs.numbers.t_max = slabs.limit(cast.t());
    found = true;
    return false;
  });
  return found;
}

bool World::closer_mesh(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const {
  bool found = false;
  auto on_mesh = [&](std::uint32_t index) {
    const PosedMesh& mesh = instances_.meshes()[index];
    if (!instances_.is_shown_to(mesh.instance, ray.kinds)) return;
    const double most =
        closest.found() ? closest.cast.t() : std::numeric_limits<double>::infinity();
    PartCounts parts;
    const Ray<double> seen = instances_.seen_by(mesh.instance, ray.ray, ray.time);
    const auto [cast, part] = cast_ray(mesh, seen, most, mesh.instance == ray.skip,
                                       instances_.loss_of_seen_by(mesh.instance, ray.ray), parts);
    counts.add_parts(parts);
    counts.exhausted += cast.status == Status::exhausted ? 1 : 0;
    if (!cast.found() || !closest.yields_to(mesh.instance, cast.t())) return;
    closest = {mesh.instance, instances_.turned(mesh.instance, cast, ray.time), part};
    found = true;
  };
  if (instances_.meshes().size() == 1) {  // the mesh's own walk begins with its box
    on_mesh(0);
    return found;
  }
  SlabRay slabs(ray.ray);
  if (closest.found()) slabs.numbers.t_max = slabs.limit(closest.cast.t());
  counts.nodes += traverse(mesh_boxes_, slabs, [&](std::uint32_t index) {
    on_mesh(index);
    if (closest.found()) slabs.numbers.t_max = slabs.limit(closest.cast.t());
    return false;
  });
  return found;
}

bool World::closer_shapeless(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const {
  if (!instances_.have_shapeless()) return false;
  const bool is_closer = closer_but_meshes(ray, closest, counts);
  return closer_mesh(ray, closest, counts) || is_closer;
}

bool World::closer_but_meshes(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const {
  const bool is_closer = closer_half_space(ray, closest, counts);
  return closer_compound(ray, closest, counts) || is_closer;
}

bool World::blocked_but_by_meshes(const WorldRay& ray, QueryCounts& counts) const {
  WorldHit any;
  bool is_blocked = closer_half_space(ray, any, counts);
  if (is_blocked || instances_.compounds().empty()) return is_blocked;
  counts.nodes += traverse(compound_boxes_, SlabRay(ray.ray), [&](std::uint32_t index) {
    const PosedCompound& compound = instances_.compounds()[index];
    const std::uint32_t instance = compound.instance;
    is_blocked =
        instances_.is_shown_to(instance, ray.kinds) &&
        is_met(compound, instances_.seen_by(instance, ray.ray, ray.time), instance == ray.skip,
               instances_.loss_of_seen_by(instance, ray.ray), options_, counts);
    return is_blocked;
  });
  return is_blocked;
}

bool World::blocked_by_shapeless(const WorldRay& ray, QueryCounts& counts) const {
  if (!instances_.have_shapeless()) return false;
  if (blocked_but_by_meshes(ray, counts)) return true;
  bool is_blocked = false;
  auto on_mesh = [&](std::uint32_t index) {
    const PosedMesh& mesh = instances_.meshes()[index];
    if (!instances_.is_shown_to(mesh.instance, ray.kinds)) return false;
    PartCounts parts;
    is_blocked = is_met(mesh, instances_.seen_by(mesh.instance, ray.ray, ray.time),
                        mesh.instance == ray.skip, parts);
    counts.add_parts(parts);
    return is_blocked;
  };
  if (instances_.meshes().size() == 1)
    on_mesh(0);
  else
    counts.nodes += traverse(mesh_boxes_, SlabRay(ray.ray), on_mesh);
  return is_blocked;
}

void World::closest_shapeless(const RaySpan& rays, std::span<WorldHit> closest,
                              std::span<std::uint8_t> is_exhausted, QueryCounts& counts) const {
  const std::size_t meshes = instances_.meshes().size();
  const bool are_together = has_screen() && rays.size() >= least_together && meshes > 0;
  std::ranges::fill(is_exhausted, std::uint8_t{0});
  const bool has_others = has_others_than_meshes();
  for (std::size_t i = 0; (has_others || !are_together) && i < rays.size(); ++i) {
    const std::uint64_t before = counts.exhausted;
    if (are_together)
      closer_but_meshes(rays[i], closest[i], counts);
    else
      closer_shapeless(rays[i], closest[i], counts);
    is_exhausted[i] = counts.exhausted > before ? 1 : 0;
  }
  if (!are_together) return;
  RaysAtMesh at_mesh;
  FirstTouchVector<SlabRay> slabs;
  const auto give_up = [&](std::uint32_t i) {
    ++counts.exhausted;
    is_exhausted[i] = 1;
  };
  const auto cast_at = [&](std::uint32_t index, std::span<const std::uint32_t> numbers) {
    const PosedMesh& mesh = instances_.meshes()[index];
    at_mesh.begin(mesh, numbers.size());
    for (const std::uint32_t i : numbers) {
      if (!instances_.is_shown_to(mesh.instance, rays.kinds(i))) continue;
      const Ray<double>& ray = rays.ray(i);
      const double most =
          closest[i].found() ? closest[i].cast.t() : std::numeric_limits<double>::infinity();
      if (!at_mesh.add(i, instances_.seen_by(mesh.instance, ray, rays.time(i)), most,
                       mesh.instance == rays.skip(i),
                       instances_.loss_of_seen_by(mesh.instance, ray)) &&
          !ray.direction.isZero(0))
        give_up(i);
    }
    PartCounts parts;
    at_mesh.find_closest(parts);
    const auto seen = [&](std::uint32_t i) {
      return instances_.seen_by(mesh.instance, rays.ray(i), rays.time(i));
    };
    at_mesh.each_closest(seen, [&](std::uint32_t i, const PartCast& answer) {
      const auto& [cast, part] = answer;
      if (cast.status == Status::exhausted) return give_up(i);
      WorldHit& hit = closest[i];
      if (!hit.yields_to(mesh.instance, cast.t())) return;
      hit = {mesh.instance, cast, part};
      hit.cast.normal = instances_.turned(mesh.instance, cast.normal, rays.time(i));
      if (!slabs.empty()) slabs[i].numbers.t_max = slabs[i].limit(cast.t());
    });
    counts.add_parts(parts);
  };
  const auto count = static_cast<std::uint32_t>(rays.size());
  std::vector<std::uint32_t> numbers;
  if (meshes == 1) {  // the mesh's traversal tests its box first
    numbers.resize(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return cast_at(0, numbers);
  }
  slabs.resize(count);
  const auto make_slabs = [&](std::uint32_t first, std::uint32_t end) {
    make_slabs_avx2(rays.part(first, end - first).data(), rays.stride(), end - first,
                    slabs.data() + first);
    for (std::uint32_t i = first; has_others && i < end; ++i)
      if (closest[i].found()) slabs[i].numbers.t_max = slabs[i].limit(closest[i].cast.t());
    return std::span(slabs).subspan(first, end - first);
  };
  std::uint32_t waiting = 0;  ///< rays from here on are not cast yet
  const auto cast_up_to = [&](std::uint32_t end) {
    const std::uint32_t first = std::exchange(waiting, end);
    if (first >= end) return;
    if (!are_worth_rounds(end - first, meshes)) {
      for (std::uint32_t i = first; i < end; ++i) {
        const std::uint64_t before = counts.exhausted;
        closer_mesh(rays[i], closest[i], counts);
        if (counts.exhausted > before) is_exhausted[i] = 1;
      }
      return;
    }
    BoxRounds rounds(mesh_boxes_, boxes_of_meshes_, make_slabs(first, end));
    counts.nodes += rounds.nodes();
    const auto visit = [&](std::uint32_t mesh, std::span<const std::uint32_t> of_round) {
      numbers.clear();
      for (const std::uint32_t i : of_round) numbers.push_back(first + i);
      cast_at(mesh, numbers);
    };
    while (rounds.next([](std::uint32_t) { return true; }, visit)) {
    }
  };
  for (std::uint32_t first = 0; first < count; first += rays_of_group) {
    const std::uint32_t end = std::min<std::uint32_t>(first + rays_of_group, count);
    if (end - first < least_rays_of_group || !may_form_group(rays.ray(first), rays.ray(end - 1)))
      continue;
    const std::span<const SlabRay> of_group = make_slabs(first, end);
    auto visit = [&](std::uint32_t mesh, std::uint32_t in) {
      numbers.clear();
      for (; in != 0; in &= in - 1)
        numbers.push_back(first + static_cast<std::uint32_t>(std::countr_zero(in)));
      cast_at(mesh, numbers);
    };
    const std::uint64_t nodes = walk_group(mesh_boxes_, of_group, visit);
    if (nodes == 0) continue;
    counts.nodes += nodes;
    cast_up_to(first);
    waiting = end;
  }
  cast_up_to(count);
}

void World::blocked_by_shapeless(const RaySpan& rays, std::span<std::uint8_t> met,
                                 QueryCounts& counts) const {
  const std::size_t meshes = instances_.meshes().size();
  const bool are_together = has_screen() && rays.size() >= least_together && meshes > 0 &&
                            are_worth_rounds(rays.size(), meshes);
  std::ranges::fill(met, std::uint8_t{0});
  for (std::size_t i = 0; (has_others_than_meshes() || !are_together) && i < rays.size(); ++i) {
    const bool is_blocked = are_together ? blocked_but_by_meshes(rays[i], counts)
                                         : blocked_by_shapeless(rays[i], counts);
    met[i] = is_blocked ? 1 : 0;
  }
  if (!are_together) return;
  RaysAtMesh at_mesh;
  const auto cast_at = [&](std::uint32_t index, std::span<const std::uint32_t> numbers) {
    const PosedMesh& mesh = instances_.meshes()[index];
    at_mesh.begin(mesh, numbers.size());
    for (const std::uint32_t i : numbers) {
      if (!instances_.is_shown_to(mesh.instance, rays.kinds(i))) continue;
      at_mesh.add(i, instances_.seen_by(mesh.instance, rays.ray(i), rays.time(i)),
                  std::numeric_limits<double>::infinity(), mesh.instance == rays.skip(i), 0);
    }
    PartCounts parts;
    at_mesh.find_any(met, parts);
    counts.add_parts(parts);
  };
  const auto is_open = [&](std::uint32_t i) { return met[i] == 0; };
  if (meshes == 1) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < rays.size(); ++i)
      if (is_open(i)) numbers.push_back(i);
    return cast_at(0, numbers);
  }
  FirstTouchVector<SlabRay> slabs(rays.size());
  make_slabs_avx2(rays.data(), rays.stride(), rays.size(), slabs.data());
  BoxRounds rounds(mesh_boxes_, boxes_of_meshes_, slabs);
  counts.nodes += rounds.nodes();
  while (rounds.next(is_open, cast_at)) {
  }
}

}  // namespace minkray
