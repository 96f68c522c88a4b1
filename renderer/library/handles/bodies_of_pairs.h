// SPDX-License-Identifier: MIT
// One side of many pairs in the C interface: shapes, prepared once, and poses and twists, checked
// when read.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/pair_motion/impact.h"
#include "core/parts/parts_body.h"
#include "renderer/library/handles/c_header.h"
#include "renderer/library/handles/held_shape.h"
#include "renderer/library/handles/poses.h"

namespace minkray {

/// A shape and its pose. A map that does not keep lengths is part of the shape, and its pose only
/// moves. Made once for many pairs: nothing is allocated for each.
class PosedBody {
 public:
  PosedBody() = default;
  /// Throws CallError if the pose cannot be used, or the shape is in use.
  PosedBody(const HeldShape& held, const minkray_pose* pose, const char* argument) {
    refuse_if_running(held.customs(), argument);
    const bool is_rigid = read_pose(pose, argument, pose_);
    if (is_rigid || !held.is_convex()) [[likely]]
      set(held);
    if (!is_rigid) [[unlikely]]
      take_map_in(held);
  }

  PartsBody parts() const {
    if (mesh_) return *mesh_;
    if (compound_) return *compound_;
    return *shape_;
  }
  bool is_shape() const { return !mesh_ && !compound_; }
  const std::shared_ptr<const TriangleMesh>& mesh() const { return mesh_; }
  const std::shared_ptr<const Compound>& compound() const { return compound_; }
  /// Only if is_shape().
  const ContactShape& shape() const { return *shape_; }
  /// A placeholder point for a mesh or compound.
  const ContactShape& shape_or_point() const;
  const Affine<double>& pose() const { return pose_; }

 private:
  friend class BodiesOfPairs;
  void set(const HeldShape& held) {
    if (!is_shape() || !held.is_convex()) [[unlikely]] {
      mesh_ = held.mesh();
      compound_ = held.compound();
    }
    if (held.is_convex()) [[likely]]
      shape_ = &held.contact();
  }
  /// Moves the linear part of the pose into the shape.
  void take_map_in(const HeldShape& held);

  const ContactShape* shape_ = nullptr;
  std::shared_ptr<const TriangleMesh> mesh_;
  std::shared_ptr<const Compound> compound_;
  Affine<double> pose_;
  /// Set if the map is part of the shape.
  std::unique_ptr<const ContactShape> own_;
};

class BodiesOfPairs {
 public:
  /// Throws CallError, which begins with the argument's name, if there are not as many things as
  /// pairs, or one; or if a shape is none.
  BodiesOfPairs(const minkray_bodies* given, std::size_t count, const char* argument);

  /// The i-th body. Throws CallError if its pose is not finite or not rigid.
  void read(std::size_t i, PosedBody& body) const;
  /// The body's motion from its pose. Throws CallError if a number is not finite.
  RigidMotion motion(std::size_t i, const PosedBody& body) const;

  /// Those of all shapes, each once.
  const std::vector<std::shared_ptr<const CustomSupport>>& customs() const { return customs_; }

 private:
  [[gnu::cold]] void read_slowly(std::size_t i, const minkray_pose& pose, PosedBody& body) const;

  const minkray_bodies& given_;
  std::string argument_;
  std::vector<const HeldShape*> shapes_;
  std::ptrdiff_t pose_step_ = 0;  ///< bytes; 0: one pose for all
  std::vector<std::shared_ptr<const CustomSupport>> customs_;
};

}  // namespace minkray
