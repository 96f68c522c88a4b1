// SPDX-License-Identifier: MIT
// Attributes of a mesh at a point of a triangle, interpolated between its corners.
#pragma once

#include <array>

#include "core/files/mesh_attributes.h"
#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// All in the mesh's frame.
struct MeshPoint {
  Vec3<double> normal = Vec3<double>::Zero();  ///< of unit length; zero if there is none
  bool has_uv = false;
  Vec3<double> uv = Vec3<double>::Zero();  ///< the third number is 0
  /// Change of the two coordinates along x, y and z.
  std::array<Vec3<double>, 2> uv_slopes = {Vec3<double>::Zero(), Vec3<double>::Zero()};
};

/// Attributes at the point of the triangle's plane; outside of the triangle, those of its edge.
MeshPoint mesh_point(const TriangleMesh& mesh, const MeshAttributes& attributes,
                     std::uint32_t triangle, const Vec3<double>& point);

/// Returns the way from a point of a triangle to the curved surface that its corners' normals
/// describe: the mean, by the corners' weights, of the ways up to the planes across these normals.
/// Zero where the surface is hollow. (Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II,
/// 2021.) The point is in the mesh's frame, the result in the frame that `to_mesh` maps to it.
/// `is_back` turns the normals.
Vec3<double> way_to_smooth(const TriangleMesh& mesh, const MeshAttributes& attributes,
                           std::uint32_t triangle, const Vec3<double>& point,
                           const Mat3<double>& to_mesh, bool is_back);

/// Bends a shading normal until a ray along `direction` sees the side of the surface that it meets:
/// its cosine is at least `least_seen_cosine`. The normal must be on the side of the outward
/// geometric one; `leaves` is true for rays that meet it from within. Normals that are seen stay as
/// they are.
Vec3<double> seen_normal(const Vec3<double>& normal, const Vec3<double>& direction, bool leaves);

/// Smooth normals near a mesh's outline may face away from the ray by up to half the angle between
/// neighbouring triangles.
inline constexpr double least_seen_cosine = 1e-2;

}  // namespace minkray
