// SPDX-License-Identifier: MIT
// Traversals of a mesh in which float lanes discard most triangles. The others are tested in
// double, so results are bit-identical to those of the traversal without lanes. Requires AVX2 and
// FMA.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/bvh/group_walk.h"
#include "core/bvh/stream.h"
#include "core/mesh/mesh_rays.h"

namespace minkray {

/// Data of a traversal.
struct MeshView {
  const BvhNode* nodes;
  const MeshLeaf* leaves;
  const double* vertices;        ///< three coordinates per vertex
  const std::uint32_t* corners;  ///< three indices per triangle
  const TriangleMesh* mesh;
};

inline MeshView view_of(const TriangleMesh& mesh) {
  return {mesh.bvh().nodes.data(), mesh.leaves().data(), mesh.vertices().data()->data(),
          mesh.triangles().data()->data(), &mesh};
}

/// True if the mesh and this machine are suitable for lanes.
inline bool has_lanes(const TriangleMesh& mesh) {
  return mesh.suits_lanes() && has_avx2();
}

/// Returns cast_at_triangle for a triangle of the mesh, with its number.
PartHit cast_at_part(const TriangleMesh& mesh, std::uint32_t triangle, const Ray<double>& ray);

/// True if the error of the hit is large relative to t, as for a triangle that the ray grazes.
inline bool is_wide(const PartHit& hit) {
  constexpr double wide = 0x1p-20;
  return hit.error > wide * hit.t;
}

/// Same as closest.yields_to(), but handles wide hits: a wide hit also yields to another hit if the
/// ray enters the box of the wide hit's triangle only beyond the other's t plus error.
bool yields_to_or_is_wide(const TriangleMesh& mesh, const Ray<double>& ray, const PartHit& closest,
                          const PartHit& hit);

/// True if the hit replaces the closest hit so far, if any.
inline bool takes_place(const TriangleMesh& mesh, const Ray<double>& ray, const PartHit& closest,
                        const PartHit& hit) {
  if (is_wide(hit) || is_wide(closest)) [[unlikely]]
    return yields_to_or_is_wide(mesh, ray, closest, hit);
  return closest.yields_to(hit);
}

/// True if the ray is suitable for lanes: products of any three coordinates of ray and mesh are
/// finite. Sums are NaN if any number is: no lane may select a triangle that a leaf does not have.
inline bool suits_lanes(const Ray<double>& ray) {
  constexpr double largest = 0x1p64, smallest = 0x1p-64;
  double origin = 0, direction = 0;
  for (int k = 0; k < 3; ++k) {
    origin += std::abs(ray.origin[k]);
    direction += std::abs(ray.direction[k]);
  }
  return origin <= largest && direction >= smallest && direction <= largest;
}

/// Casts one suitable ray at a suitable mesh.
PartHit closest_part_avx2(const MeshView& view, const Ray<double>& ray, double t_min,
                          PartCounts& counts);
bool meets_part_avx2(const MeshView& view, const Ray<double>& ray, double t_min,
                     PartCounts& counts);

/// Calls take(context, hit) as visit_hits does.
void visit_hits_avx2(const MeshView& view, const Ray<double>& ray, PartCounts& counts,
                     void (*take)(void* context, const PartHit& hit), void* context);

/// Calls take(hit) for all hits up to ray.t_max and for some beyond it, in any order.
template <class Take>
void visit_hits(const TriangleMesh& mesh, const Ray<double>& ray, PartCounts& counts, Take&& take) {
  if (has_lanes(mesh) && suits_lanes(ray)) {
    const auto plain = [](void* context, const PartHit& hit) {
      (*static_cast<std::remove_reference_t<Take>*>(context))(hit);
    };
    return visit_hits_avx2(view_of(mesh), ray, counts, plain, &take);
  }
  walk_triangles(mesh, ray, counts, [&](std::uint32_t triangle, SlabRay&) {
    if (const PartHit hit = cast_at_part(mesh, triangle, ray); hit.found()) take(hit);
    return false;
  });
}

/// Casts up to most_rays_of_walk suitable rays. Before the call, `hits` must contain only misses.
inline constexpr std::size_t most_rays_of_walk = 1024;
void closest_parts_avx2(const MeshView& view, const PartRay* rays, std::size_t count, PartHit* hits,
                        PartCounts& counts);
/// Casts up to rays_of_group suitable rays with similar directions.
enum class GroupResult : unsigned char {
  none,       ///< the directions are too different: no ray was cast
  alike,      ///< all rays have results
  scattered,  ///< all rays have results, but meet different leaves, so streams are faster
};
GroupResult closest_parts_of_group_avx2(const MeshView& view, const PartRay* rays,
                                        std::size_t count, PartHit* hits, PartCounts& counts);

void meet_parts_avx2(const MeshView& view, const PartRay* rays, std::size_t count,
                     std::uint8_t* met, PartCounts& counts);

}  // namespace minkray
