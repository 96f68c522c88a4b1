// SPDX-License-Identifier: MIT
// A mesh with its pose: a ray is brought into the mesh's frame, once for all of its triangles.
#pragma once

#include <memory>

#include "core/math/affine.h"
#include "core/mesh/mesh_ray.h"
#include "core/query/result.h"

namespace minkray {

struct PosedMesh {
  std::uint32_t instance = 0;
  std::shared_ptr<const TriangleMesh> mesh;
  Affine<double> pose;                              ///< from the mesh's frame to the world
  Mat3<double> to_mesh = Mat3<double>::Identity();  ///< the inverse of its linear part
  bool is_turned = false;                           ///< that is not the identity

  PosedMesh() = default;
  PosedMesh(std::uint32_t number, std::shared_ptr<const TriangleMesh> of, const Affine<double>& at);

  /// A box in the world that holds it.
  Bounds<double> bounds() const { return bounds_under(pose); }
  Bounds<double> bounds_under(const Affine<double>& other) const;
};

/// A ray's hit of a posed mesh, and the triangle. The normal is that of the triangle, on the side
/// that the ray comes from.
struct MeshCast {
  CastResult<double> cast;
  std::uint32_t part = no_part;
};

/// A ray that leaves the mesh does not meet it within this much of its size and of the ray's way
/// there: less is rounding of the point where it begins.
inline constexpr double leaving_mesh = 0x1p-36;

/// `most` is a t beyond which hits do not matter; it may be infinite. `loss` is how far the ray's
/// place may be off. A miss is exhausted instead where numbers are too large.
MeshCast cast_ray(const PosedMesh& posed, const Ray<double>& ray, double most, bool leaves,
                  double loss, PartCounts& counts);
/// Finds where a ray from outside of a closed mesh leaves it again: the second time that it passes
/// through, or the first if there is no second. Only the status and t are set.
CastResult<double> cast_exit(const PosedMesh& posed, const Ray<double>& ray);
/// True if the mesh is met up to ray.t_max.
bool is_met(const PosedMesh& posed, const Ray<double>& ray, bool leaves, PartCounts& counts);

}  // namespace minkray
