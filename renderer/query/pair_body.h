// SPDX-License-Identifier: MIT
// A query's body at a rigid pose, as queries on pairs take it.
#pragma once

#include <optional>

#include "core/pair_motion/impact.h"
#include "core/parts/parts_body.h"
#include "renderer/query/query.h"

namespace minkray {

/// Refers to the query's body, which must outlive it.
class PairBody {
 public:
  /// Throws std::runtime_error if the mesh's vertices under the pose are out of range.
  explicit PairBody(const QueryBody& body, const ImpactMotion& motion = {});

  PartsBody parts() const { return mesh_ ? PartsBody(*mesh_) : PartsBody(*shape_); }
  const Affine<double>& pose() const { return motion_.pose; }
  const RigidMotion& motion() const { return motion_; }
  /// Middle and radius of a ball that contains the body at time 0.
  Vec3<double> middle() const { return pose()(middle_of(parts())); }
  double radius() const { return reach_of(parts()) + middle_of(parts()).norm(); }

  /// A triangle of the mesh, in the query's frame; the shape itself if there is no mesh.
  Shape part(std::uint32_t number) const;

 private:
  const QueryBody& body_;
  std::shared_ptr<const TriangleMesh> mesh_;
  std::optional<ContactShape> shape_;
  RigidMotion motion_;
};

/// A triangle of a mesh under a pose: its corners round once.
Shape posed_triangle(const TriangleMesh& mesh, std::uint32_t number, const Affine<double>& pose);

}  // namespace minkray
