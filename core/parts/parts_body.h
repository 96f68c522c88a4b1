// SPDX-License-Identifier: MIT
// What queries on pairs take: a convex shape, or a mesh, whose parts are its triangles.
#pragma once

#include "core/contact/contact_shape.h"
#include "core/mesh/triangle_mesh.h"

namespace minkray {

/// A convex shape, or a mesh. Refers to either.
class PartsBody {
 public:
  PartsBody(const ContactShape& shape) : shape_(&shape) {}
  PartsBody(const TriangleMesh& mesh) : mesh_(&mesh) {}

  /// Null of the other kind.
  const ContactShape* shape() const { return shape_; }
  const TriangleMesh* mesh() const { return mesh_; }

 private:
  const ContactShape* shape_ = nullptr;
  const TriangleMesh* mesh_ = nullptr;
};

/// The triangles that an answer is of; no_part of a shape.
struct PartPair {
  std::uint32_t a = no_part, b = no_part;
};

/// A box that holds the body at a rigid pose: of a shape the least but for a rounding outwards.
Bounds<double> bounds_of(const PartsBody& body, const Affine<double>& pose);
/// How far the body reaches from the origin of its frame, or a little more.
double reach_of(const PartsBody& body);
/// The middle of a shape, or of the box of a mesh, in its frame.
Vec3<double> middle_of(const PartsBody& body);

}  // namespace minkray
