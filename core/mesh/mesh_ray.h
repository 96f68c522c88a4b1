// SPDX-License-Identifier: MIT
// Finds where rays hit a mesh. The side of an edge on which a ray passes is computed exactly, so a
// ray through an edge or corner of a closed mesh hits one of the triangles there.
#pragma once

#include "core/bvh/traverse.h"
#include "core/math/ray.h"
#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// A point where a ray passes through a triangle, from either side.
struct PartHit {
  std::uint32_t part = no_part;  ///< the triangle's number
  double t = std::numeric_limits<double>::infinity();
  double error = 0;      ///< bound of |t - true t| for the ray as given
  bool is_back = false;  ///< true if the triangle's vertices are clockwise as seen from the ray's
                         ///< origin
  bool is_at_edge = false;  ///< the ray passes exactly through an edge or corner

  bool found() const { return part != no_part; }
  /// True if the other triangle's hit comes before this one.
  bool yields_to(const PartHit& other) const {
    return other.t < t || (other.t == t && other.part < part);
  }
};

/// Finds where the ray passes through one triangle with 0 <= t. A ray within the triangle's plane
/// does not pass through it.
PartHit cast_at_triangle(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c,
                         const Ray<double>& ray);

/// Cost of traversing a mesh's triangles.
struct PartCounts {
  std::uint64_t nodes = 0, triangles = 0;
};

/// Calls on_triangle(number, slabs) for all triangles whose boxes the ray meets and, due to
/// rounding, for some others. on_triangle may lower slabs.numbers.t_max, and ends the traversal by
/// returning true.
template <class OnTriangle>
void walk_triangles(const TriangleMesh& mesh, const Ray<double>& ray, PartCounts& counts,
                    OnTriangle&& on_triangle) {
  SlabRay slabs(ray);
  Bvh triangles;
  triangles.nodes.resize(1);
  counts.nodes += traverse(mesh.bvh(), slabs, [&](std::uint32_t leaf) {
    bool is_over = false;
    triangles.nodes[0] = mesh.boxes_of_leaf(leaf);
    traverse(triangles, slabs, [&](std::uint32_t triangle) {
      ++counts.triangles;
      return is_over = on_triangle(triangle, slabs);
    });
    return is_over;
  });
}

/// Returns the hit with the least t in [t_min, ray.t_max]. If several triangles are hit at this t,
/// returns the hit of the triangle with the least number.
PartHit closest_part(const TriangleMesh& mesh, const Ray<double>& ray, double t_min,
                     PartCounts& counts);
/// True if there is any hit with t in [t_min, ray.t_max].
bool meets_part(const TriangleMesh& mesh, const Ray<double>& ray, double t_min, PartCounts& counts);
/// Returns all hits, sorted by t and then by number.
std::vector<PartHit> all_parts(const TriangleMesh& mesh, const Ray<double>& ray);

/// True if a closed mesh winds around the point. False for all points if the mesh is open, and for
/// points on the surface.
bool is_within(const TriangleMesh& mesh, const Vec3<double>& point);

}  // namespace minkray
