// SPDX-License-Identifier: MIT
// A mesh with its pose. A ray is mapped to the mesh's frame once for all triangles.
#pragma once

#include <memory>
#include <vector>

#include "core/math/affine.h"
#include "core/mesh/mesh_ray.h"
#include "core/query/result.h"

namespace minkray {

struct PosedMesh {
  std::uint32_t instance = 0;
  std::shared_ptr<const TriangleMesh> mesh;
  Affine<double> pose;                              ///< maps the mesh's frame to the world
  Mat3<double> to_mesh = Mat3<double>::Identity();  ///< inverse of the pose's linear part
  bool is_turned = false;                           ///< true if to_mesh is not the identity

  PosedMesh() = default;
  PosedMesh(std::uint32_t number, std::shared_ptr<const TriangleMesh> of, const Affine<double>& at);

  /// Bounding box in the world.
  Bounds<double> bounds() const { return bounds_under(pose); }
  Bounds<double> bounds_under(const Affine<double>& other) const;
  /// The same, but smaller if the mesh is turned: around boxes of its BVH.
  Bounds<double> tight_bounds_under(const Affine<double>& other) const;
};

/// Result of a cast at a posed mesh or compound, and the hit part. The normal of a triangle is that
/// on the side of the ray's origin.
struct PartCast {
  CastResult<double> cast;
  std::uint32_t part = no_part;
};

/// Least distance of hits from the origin of a ray that starts on the mesh; nearer hits are due to
/// rounding of the origin. Relative to the mesh's size plus the ray's distance from the mesh.
inline constexpr double leaving_mesh = 0x1p-36;

/// Finds the first triangle that the ray hits at t <= `most`, which may be infinite. `leaves`: the
/// ray starts on the mesh (leaving_mesh). `loss` is the error bound of the ray's position. Returns
/// `exhausted` instead of a miss if numbers are too large.
PartCast cast_ray(const PosedMesh& posed, const Ray<double>& ray, double most, bool leaves,
                  double loss, PartCounts& counts);
/// Finds where a ray from outside leaves a closed mesh: at the second intersection, or at the first
/// one if there is only one. Sets only the status and t.
CastResult<double> cast_exit(const PosedMesh& posed, const Ray<double>& ray);
/// Finds where the ray leaves the mesh for the last time: the last hit of any triangle. The status
/// is `inside` if the ray's end (at ray.t_max) is within a closed mesh. The normal points along the
/// ray.
PartCast cast_last_exit(const PosedMesh& posed, const Ray<double>& ray, double loss);

/// A point where a ray enters or leaves a part. The normal of a triangle is on its front, given by
/// the order of its vertices.
struct PartCrossing {
  PartCast at;
  bool leaves = false;  ///< the ray runs in the direction of the normal
};
/// Appends all triangles that the ray passes through, in the order of crossings()
/// (core/mesh/crossings.h). Returns false if numbers are too large.
bool add_crossings(const PosedMesh& posed, const Ray<double>& ray, double loss,
                   std::vector<PartCrossing>& to);

/// True if the ray hits the mesh at t <= ray.t_max.
bool is_met(const PosedMesh& posed, const Ray<double>& ray, bool leaves, PartCounts& counts);

}  // namespace minkray
