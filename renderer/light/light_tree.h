// SPDX-License-Identifier: MIT
// Choosing one of many lights by how much it may send to a point: a binary tree of them, walked
// down from its root by chance, at each node in proportion to the power over the squared distance
// of either side (Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree
// Splitting", 2018; without cones of normals, for convex bodies shine to all sides).
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
  /// Its first child comes right behind it.
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
  /// To go on with the first child of an inner node.
  double chance_of_first(std::uint32_t node, const Vec3<double>& point) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_;  ///< by light
};

}  // namespace minkray
