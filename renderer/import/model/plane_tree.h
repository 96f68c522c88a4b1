// SPDX-License-Identifier: MIT
// Finds, of many planes, the one that a point lies the least below. Planes are points (normal,
// offset) in a tree of four-dimensional boxes. The depth offset - normal . point is linear, so a
// box's corner bounds it. Checking every plane took minutes for a ball of half a million vertices.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

class PlaneTree {
 public:
  using Plane = std::array<double, 4>;  ///< normal and offset: normal . x = offset

  /// Planes that are not finite are left out. Query points are at most `size` from the origin.
  PlaneTree(std::vector<Plane> planes, double size) : planes_(std::move(planes)), size_(size) {
    std::erase_if(planes_, [](const Plane& plane) {
      return !std::ranges::all_of(plane, [](double x) { return std::isfinite(x); });
    });
    if (!planes_.empty()) build(0, planes_.size());
  }

  /// Least depth of the point below any plane; infinity without planes. If the depth is no more
  /// than `enough` below any of them, the result is some distance up to `enough`.
  double least_depth(const Vec3<double>& point, double enough) const {
    double least = std::numeric_limits<double>::infinity();
    if (!nodes_.empty()) search(0, point, enough, least);
    return least;
  }

 private:
  struct Node {
    Plane low, high;
    std::size_t begin, end;
    std::size_t second;  ///< child; the first one is the next node. 0: it is a leaf
  };
  static constexpr std::size_t most_in_leaf = 8;

  static double below(const Plane& plane, const Vec3<double>& p) {
    return plane[3] - (plane[0] * p.x() + plane[1] * p.y() + plane[2] * p.z());
  }

  /// No plane of the node has the point less below it, rounding included: below() is monotonic.
  static double bound(const Node& node, const Vec3<double>& p) {
    Plane corner = {0, 0, 0, node.low[3]};
    for (std::size_t k = 0; k < 3; ++k)
      corner[k] = p[static_cast<int>(k)] < 0 ? node.low[k] : node.high[k];
    return below(corner, p);
  }

  void search(std::size_t at, const Vec3<double>& point, double enough, double& least) const {
    const Node& node = nodes_[at];
    if (least <= enough || bound(node, point) >= least) return;
    if (node.second == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i)
        least = std::min(least, below(planes_[i], point));
      return;
    }
    const std::size_t first = at + 1, second = node.second;
    const bool is_nearer = bound(nodes_[second], point) < bound(nodes_[first], point);
    search(is_nearer ? second : first, point, enough, least);
    search(is_nearer ? first : second, point, enough, least);
  }

  void build(std::size_t begin, std::size_t end) {
    Node node{planes_[begin], planes_[begin], begin, end, 0};
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        node.low[k] = std::min(node.low[k], planes_[i][k]);
        node.high[k] = std::max(node.high[k], planes_[i][k]);
      }
    std::size_t widest = 0;
    double width = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double here = (node.high[k] - node.low[k]) * (k < 3 ? size_ : 1);
      if (here > width) {
        widest = k;
        width = here;
      }
    }
    const std::size_t at = nodes_.size();
    nodes_.push_back(node);
    if (end - begin <= most_in_leaf || width == 0) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto place = [&](std::size_t i) {
      return planes_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(place(begin), place(middle), place(end),
                     [&](const Plane& a, const Plane& b) { return a[widest] < b[widest]; });
    build(begin, middle);
    nodes_[at].second = nodes_.size();
    build(middle, end);
  }

  std::vector<Plane> planes_;
  double size_;
  std::vector<Node> nodes_;
};

}  // namespace minkray
