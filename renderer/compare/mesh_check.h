// SPDX-License-Identifier: MIT
// Compares meshes with Embree on the same triangles. Vertices are rounded to float for both, so
// only the arithmetic differs.
#pragma once

#include "core/world/posed_mesh.h"
#include "renderer/compare/sandwich_check.h"

namespace minkray {

class MeshCheck {
 public:
  explicit MeshCheck(const PosedMesh& in_world);

  /// t_outer and t_inner are Embree's t less and more what it may be off. Where the two disagree,
  /// each triangle in double decides who is wrong.
  Verdict judge(const Ray<float>& ray) const;

  /// A ray of the world, with numbers in float, from near the mesh.
  RayInFrame to_frame(const Ray<double>& ray) const;

  /// Rays from outside, at points of triangles, at edges, at vertices, and past the mesh.
  CompareReport compare(const CompareOptions& options) const;

  const Bounds<double>& bounds() const { return bounds_; }

 private:
  Bounds<double> bounds_;  ///< in the world
  Vec3<double> centre_;
  double radius_;
  PosedMesh rounded_;  ///< about the centre
  EmbreeMesh embree_;
};

}  // namespace minkray
