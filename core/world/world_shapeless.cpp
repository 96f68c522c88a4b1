// SPDX-License-Identifier: MIT
// Casts at half-spaces and meshes. A world has few of them; they come before shapes, as their hits
// limit the rays.
#include <algorithm>

#include "core/bvh/traverse.h"
#include "core/world/posed_mesh_rays.h"
#include "core/world/world.h"

namespace minkray {
namespace {

/// Least number of rays to trace together; fewer are faster one by one.
constexpr std::size_t least_together = 4;

/// Largest number of meshes for tracing rays together: with more, a ray traced alone skips the
/// meshes behind its first hit.
constexpr std::size_t most_meshes = 2;

/// True if rays are traced at meshes together.
bool go_together(std::size_t rays, std::size_t meshes) {
  return rays >= least_together && meshes > 0 && meshes <= most_meshes;
}

/// A ray and a mesh whose box it hits.
struct RayAtMesh {
  std::uint32_t mesh, ray;
};

/// Meshes whose boxes rays hit, in rounds: the next mesh of each ray, sorted by mesh.
class Rounds {
 public:
  Rounds(const Bvh& boxes, std::size_t meshes, const RaySpan& rays, QueryCounts& counts)
      : begins_(rays.size() + 1), next_(rays.size()) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      begins_[i] = next_[i] = meshes_.size();
      if (meshes == 1) {  // the traversal of a single mesh tests its box first
        meshes_.push_back(0);
        continue;
      }
      counts.nodes += traverse(boxes, SlabRay(rays.ray(i)), [&](std::uint32_t mesh) {
        meshes_.push_back(mesh);
        return false;
      });
    }
    begins_.back() = meshes_.size();
  }

  /// Calls visit(mesh, rays) for each mesh in the next round, with the open rays. Returns false if
  /// the round is empty.
  template <class IsOpen, class Visit>
  bool next(const IsOpen& is_open, const Visit& visit) {
    pairs_.clear();
    for (std::uint32_t i = 0; i < next_.size(); ++i)
      if (next_[i] < begins_[i + 1] && is_open(i)) pairs_.push_back({meshes_[next_[i]++], i});
    if (!std::ranges::is_sorted(pairs_, {}, &RayAtMesh::mesh))
      std::ranges::stable_sort(pairs_, {}, &RayAtMesh::mesh);
    for (std::size_t from = 0, to; from < pairs_.size(); from = to) {
      to = from;
      rays_.clear();
      for (; to < pairs_.size() && pairs_[to].mesh == pairs_[from].mesh; ++to)
        rays_.push_back(pairs_[to].ray);
      visit(pairs_[from].mesh, std::span<const std::uint32_t>(rays_));
    }
    return !pairs_.empty();
  }

 private:
  std::vector<std::uint32_t> meshes_, rays_;
  std::vector<std::size_t> begins_, next_;
  std::vector<RayAtMesh> pairs_;
};

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
  const bool is_closer = closer_half_space(ray, closest, counts);
  return closer_mesh(ray, closest, counts) || is_closer;
}

bool World::blocked_by_shapeless(const WorldRay& ray, QueryCounts& counts) const {
  if (!instances_.have_shapeless()) return false;
  WorldHit any;
  if (closer_half_space(ray, any, counts)) return true;
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
  const bool are_together = has_screen() && go_together(rays.size(), instances_.meshes().size());
  std::ranges::fill(is_exhausted, std::uint8_t{0});
  const bool has_half_spaces = !instances_.half_spaces().empty();
  for (std::size_t i = 0; (has_half_spaces || !are_together) && i < rays.size(); ++i) {
    const std::uint64_t before = counts.exhausted;
    if (are_together)
      closer_half_space(rays[i], closest[i], counts);
    else
      closer_shapeless(rays[i], closest[i], counts);
    is_exhausted[i] = counts.exhausted > before ? 1 : 0;
  }
  if (!are_together) return;
  Rounds rounds(mesh_boxes_, instances_.meshes().size(), rays, counts);
  std::vector<MeshQuery> queries;
  std::vector<std::uint32_t> asked;
  const auto visit = [&](std::uint32_t index, std::span<const std::uint32_t> numbers) {
    const PosedMesh& mesh = instances_.meshes()[index];
    queries.clear();
    asked.clear();
    for (const std::uint32_t i : numbers) {
      if (!instances_.is_shown_to(mesh.instance, rays.kinds(i))) continue;
      const Ray<double>& ray = rays.ray(i);
      const double most =
          closest[i].found() ? closest[i].cast.t() : std::numeric_limits<double>::infinity();
      queries.push_back({instances_.seen_by(mesh.instance, ray, rays.time(i)), most,
                         mesh.instance == rays.skip(i),
                         instances_.loss_of_seen_by(mesh.instance, ray)});
      asked.push_back(i);
    }
    PartCounts parts;
    cast_rays(mesh, queries, parts, [&](std::size_t k, const MeshCast& answer) {
      const auto& [cast, part] = answer;
      const std::uint32_t i = asked[k];
      if (cast.status == Status::exhausted) {
        ++counts.exhausted;
        is_exhausted[i] = 1;
      }
      if (cast.found() && closest[i].yields_to(mesh.instance, cast.t()))
        closest[i] = {mesh.instance, instances_.turned(mesh.instance, cast, rays.time(i)), part};
    });
    counts.add_parts(parts);
  };
  while (rounds.next([](std::uint32_t) { return true; }, visit)) {
  }
}

void World::blocked_by_shapeless(const RaySpan& rays, std::span<std::uint8_t> met,
                                 QueryCounts& counts) const {
  const bool are_together = has_screen() && go_together(rays.size(), instances_.meshes().size());
  std::ranges::fill(met, std::uint8_t{0});
  const bool has_half_spaces = !instances_.half_spaces().empty();
  for (std::size_t i = 0; (has_half_spaces || !are_together) && i < rays.size(); ++i) {
    WorldHit any;
    const bool is_blocked = are_together ? closer_half_space(rays[i], any, counts)
                                         : blocked_by_shapeless(rays[i], counts);
    met[i] = is_blocked ? 1 : 0;
  }
  if (!are_together) return;
  Rounds rounds(mesh_boxes_, instances_.meshes().size(), rays, counts);
  std::vector<MeshQuery> queries;
  std::vector<std::uint8_t> are;
  std::vector<std::uint32_t> asked;
  const auto visit = [&](std::uint32_t index, std::span<const std::uint32_t> numbers) {
    const PosedMesh& mesh = instances_.meshes()[index];
    queries.clear();
    asked.clear();
    for (const std::uint32_t i : numbers) {
      if (!instances_.is_shown_to(mesh.instance, rays.kinds(i))) continue;
      MeshQuery query;
      query.ray = instances_.seen_by(mesh.instance, rays.ray(i), rays.time(i));
      query.leaves = mesh.instance == rays.skip(i);
      queries.push_back(query);
      asked.push_back(i);
    }
    are.resize(queries.size());
    PartCounts parts;
    are_met(mesh, queries, are, parts);
    counts.add_parts(parts);
    for (std::size_t k = 0; k < asked.size(); ++k) met[asked[k]] |= are[k];
  };
  while (rounds.next([&](std::uint32_t i) { return met[i] == 0; }, visit)) {
  }
}

}  // namespace minkray
