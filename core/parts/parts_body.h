// SPDX-License-Identifier: MIT
// A body in queries on pairs: a convex shape, which is its own only part, or a mesh, whose parts
// are its triangles.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/pair/contact_shape.h"

namespace minkray {

/// Reference to a convex shape or to a mesh.
class PartsBody {
 public:
  PartsBody(const ContactShape& shape) : shape_(&shape) {}
  PartsBody(const TriangleMesh& mesh) : mesh_(&mesh) {}

  /// Null for a mesh.
  const ContactShape* shape() const { return shape_; }
  const TriangleMesh* mesh() const { return mesh_; }

 private:
  const ContactShape* shape_ = nullptr;
  const TriangleMesh* mesh_ = nullptr;
};

/// Numbers of the triangles that a result belongs to; no_part for a shape.
struct PartPair {
  std::uint32_t a = no_part, b = no_part;
};

/// Bounding box of the body at a rigid pose. For shapes, the box is tight up to rounding.
Bounds<double> bounds_of(const PartsBody& body, const Affine<double>& pose);
/// Upper bound of the distance of the body's points from the origin of its frame.
double reach_of(const PartsBody& body);
/// Middle of a shape, or of a mesh's box, in its frame.
Vec3<double> middle_of(const PartsBody& body);

}  // namespace minkray
