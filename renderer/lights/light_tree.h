// SPDX-License-Identifier: MIT
// Chooses one of many lights by its likely contribution at a point: walks a binary tree from the
// root, at each node choosing a side in proportion to power over squared distance (Conty Estevez
// and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018; without
// normal cones, since convex bodies emit to all sides).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

class LightTree {
 public:
  /// A ball about the light; the power is positive, in any unit.
  struct Light {
    Vec3<double> centre;
    double radius, power;
  };

  LightTree() = default;
  /// At least one light; they are known by their places in the list.
  explicit LightTree(std::span<const Light> lights);

  bool empty() const { return nodes_.empty(); }

  /// Draws one by a number in [0, 1).
  std::size_t choose(const Vec3<double>& point, double u) const;
  /// The chance with which `choose` draws it.
  double chance(const Vec3<double>& point, std::size_t light) const;

 private:
  /// The first child is the next node.
  struct Node {
    Vec3<double> centre;
    double radius2, power;
    std::uint32_t second;  ///< the other child; of a leaf the light
    std::uint32_t parent;
    bool is_leaf;
  };

  std::uint32_t build(std::span<const Light> lights, std::span<std::uint32_t> which,
                      std::uint32_t parent);
  double importance(const Node& node, const Vec3<double>& point) const;
  /// Probability of continuing with the first child of an inner node.
  double chance_of_first(std::uint32_t node, const Vec3<double>& point) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_;  ///< by light
};

}  // namespace minkray
