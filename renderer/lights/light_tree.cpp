// SPDX-License-Identifier: MIT
#include "renderer/lights/light_tree.h"

#include <algorithm>
#include <numeric>

#include "core/math/bounds.h"

namespace minkray {

LightTree::LightTree(std::span<const Light> lights) : leaf_of_(lights.size()) {
  std::vector<std::uint32_t> which(lights.size());
  std::iota(which.begin(), which.end(), 0u);
  nodes_.reserve(2 * lights.size());
  if (!lights.empty()) build(lights, which, 0);
}

/// Halves by the median of the centres along their longest extent, so that the tree is as deep as
/// the logarithm of their number.
std::uint32_t LightTree::build(std::span<const Light> lights, std::span<std::uint32_t> which,
                               std::uint32_t parent) {
  Bounds<double> centres, bodies;
  double power = 0;
  for (const std::uint32_t light : which) {
    const Light& one = lights[light];
    centres.extend(one.centre);
    bodies.extend(Vec3<double>(one.centre - Vec3<double>::Constant(one.radius)));
    bodies.extend(Vec3<double>(one.centre + Vec3<double>::Constant(one.radius)));
    power += one.power;
  }
  const Vec3<double> middle = 0.5 * (bodies.lower + bodies.upper);
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({middle, 0.25 * (bodies.upper - bodies.lower).squaredNorm(), power, which[0],
                    parent, which.size() == 1});
  if (which.size() == 1) {
    leaf_of_[which[0]] = node;
    return node;
  }
  int axis = 0;
  (centres.upper - centres.lower).maxCoeff(&axis);
  const std::size_t half = which.size() / 2;
  std::nth_element(which.begin(), which.begin() + static_cast<std::ptrdiff_t>(half), which.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = lights[a].centre[axis], y = lights[b].centre[axis];
                     return x != y ? x < y : a < b;
                   });
  build(lights, which.first(half), node);
  nodes_[node].second = build(lights, which.subspan(half), node);
  return node;
}

double LightTree::importance(const Node& node, const Vec3<double>& point) const {
  return node.power / std::max((node.centre - point).squaredNorm(), node.radius2);
}

double LightTree::chance_of_first(std::uint32_t node, const Vec3<double>& point) const {
  const double first = importance(nodes_[node + 1], point);
  return first / (first + importance(nodes_[nodes_[node].second], point));
}

std::size_t LightTree::choose(const Vec3<double>& point, double u) const {
  std::uint32_t node = 0;
  while (!nodes_[node].is_leaf) {
    const double first = chance_of_first(node, point);
    const bool is_first = u < first;
    u = is_first ? u / first : (u - first) / (1 - first);
    node = is_first ? node + 1 : nodes_[node].second;
  }
  return nodes_[node].second;
}

double LightTree::chance(const Vec3<double>& point, std::size_t light) const {
  double chance = 1;
  for (std::uint32_t node = leaf_of_[light]; node != 0; node = nodes_[node].parent) {
    const std::uint32_t parent = nodes_[node].parent;
    const double first = chance_of_first(parent, point);
    chance *= node == parent + 1 ? first : 1 - first;
  }
  return chance;
}

}  // namespace minkray
