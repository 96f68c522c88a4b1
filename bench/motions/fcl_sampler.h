// SPDX-License-Identifier: MIT
// The bodies of a workcell as FCL has them, triangles and primitives, and whether pairs of them
// collide at a moment: a judge of verdicts that shares nothing with their distances.
#pragma once

#include <memory>
#include <vector>

#include "renderer/plan/workcell.h"

namespace minkray {

enum class Triangles : unsigned char {
  of_meshes,  ///< of mesh files, as they are
  of_hulls,   ///< of their convex hulls, which the verdict is of
};

class FclSampler {
 public:
  FclSampler(const Workcell& cell, Triangles triangles);
  ~FclSampler();

  /// Indices of the pairs that collide according to FCL; those with a plane are left out.
  std::vector<std::size_t> colliding_pairs(const JointPath& path, double time, bool first_only);
  bool collides(const JointPath& path, double time, std::size_t pair);

 private:
  struct Bodies;
  void place(const JointPath& path, double time);
  const Workcell& cell_;
  std::unique_ptr<Bodies> bodies_;
};

}  // namespace minkray
