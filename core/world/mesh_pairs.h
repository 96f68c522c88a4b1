// SPDX-License-Identifier: MIT
// How far apart two bodies are of which at least one is a mesh, and when they first touch: the
// least of all pairs of their parts, each of which is convex, so that the bounds of parts are
// bounds of the whole. The hierarchies' boxes tell which pairs need not be looked at.
#pragma once

#include <memory>

#include "core/contact/half_space_distance.h"
#include "core/contact/impact.h"
#include "core/contact/manifold.h"
#include "core/contact/pair_derivative.h"
#include "core/contact/signed_distance.h"
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

/// A box that holds the body at a rigid pose: of a shape the least but for a rounding outwards.
Bounds<double> bounds_of(const PartsBody& body, const Affine<double>& pose);
/// How far the body reaches from the origin of its frame, or a little more.
double reach_of(const PartsBody& body);

/// The triangles that an answer is of; no_part of a shape.
struct PartPair {
  std::uint32_t a = no_part, b = no_part;
};

/// The distance of surfaces. Where they cross, or one body lies within the other (which of meshes
/// only closed ones allow), the status is overlapping, value and both bounds are 0, and the points
/// are of the two parts that cross, or one point of what is within: there is no depth. The
/// poses are rigid.
SignedDistance signed_distance(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                               const Affine<double>& pose_b,
                               const SignedDistanceOptions& options = {},
                               PartPair* parts = nullptr);

/// The first contact at times from 0 to t_max: inside if the bodies overlap at time 0.
Impact first_impact(const PartsBody& a, const RigidMotion& motion_a, const PartsBody& b,
                    const RigidMotion& motion_b, double t_max, const ImpactOptions& options = {},
                    PartPair* parts = nullptr);

/// Looks at no more than the two parts that are nearest, or that cross. There are no points where
/// one body is within the other without a crossing.
ContactManifold contact_manifold(const PartsBody& a, const Affine<double>& pose_a,
                                 const PartsBody& b, const Affine<double>& pose_b);

/// How the distance changes: of the two parts that are nearest. Of surfaces that cross it is zero,
/// and a ridge.
PairDerivative derivative_of(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                             const Affine<double>& pose_b);
/// How the time of impact changes.
PairDerivative derivative_of(const PartsBody& a, const RigidMotion& motion_a, const PartsBody& b,
                             const RigidMotion& motion_b, double t_max);

/// How far a body is above the plane of a half-space; less than 0 if a part of it is below.
SignedDistance distance_to_half_space(const PlacedPlane& plane, const PartsBody& body,
                                      const Affine<double>& pose);

/// Whether triangles of more than one direction are within `near` of a point in the mesh's frame.
bool bends_at(const TriangleMesh& mesh, const Vec3<double>& point, double near);

/// The mesh under a map that need not be rigid.
std::shared_ptr<const TriangleMesh> mapped(const TriangleMesh& mesh, const Mat3<double>& linear);

}  // namespace minkray
