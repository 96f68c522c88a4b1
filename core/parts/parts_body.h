// SPDX-License-Identifier: MIT
// A body in queries on pairs: a convex shape, which is its own only part, a mesh, whose parts are
// its triangles, or a compound.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/pair/contact_shape.h"
#include "core/parts/compound.h"

namespace minkray {

/// Reference to a convex shape, a mesh or a compound.
class PartsBody {
 public:
  PartsBody(const ContactShape& shape) : shape_(&shape) {}
  PartsBody(const TriangleMesh& mesh) : mesh_(&mesh) {}
  PartsBody(const Compound& compound) : compound_(&compound) {}

  /// Two of these are null.
  const ContactShape* shape() const { return shape_; }
  const TriangleMesh* mesh() const { return mesh_; }
  const Compound* compound() const { return compound_; }

  /// Number of triangles, or of a compound's parts; 0 for a shape.
  std::size_t size() const { return mesh_ ? mesh_->size() : compound_ ? compound_->size() : 0; }

 private:
  const ContactShape* shape_ = nullptr;
  const TriangleMesh* mesh_ = nullptr;
  const Compound* compound_ = nullptr;
};

/// Numbers of the parts that a result belongs to; no_part for a shape.
struct PartPair {
  std::uint32_t a = no_part, b = no_part;
};

/// Bounding box of the body at a rigid pose. For shapes and compounds, the box is tight up to
/// rounding.
Bounds<double> bounds_of(const PartsBody& body, const Affine<double>& pose);
/// Upper bound of the distance of the body's points from the origin of its frame.
double reach_of(const PartsBody& body);
/// Middle of a shape, or of the box of a mesh or compound, in its frame.
Vec3<double> middle_of(const PartsBody& body);

}  // namespace minkray
