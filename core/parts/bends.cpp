// SPDX-License-Identifier: MIT
#include "core/parts/bends.h"

#include <optional>

#include "core/pair/triangle_part.h"
#include "core/pair_distance/signed_distance.h"

namespace minkray {
namespace {

bool is_near(const BvhNode& node, int child, const Vec3<double>& point, double near) {
  const Bounds<float> box = node.box(child);
  const Vec3<double> lower = box.lower.cast<double>(), upper = box.upper.cast<double>();
  constexpr double rounded = 1 - 8 * std::numeric_limits<double>::epsilon();
  return rounded * (lower - point).cwiseMax(point - upper).cwiseMax(0).norm() <= near;
}

}  // namespace

bool bends_at(const TriangleMesh& mesh, const Vec3<double>& point, double near) {
  constexpr double same_direction = 1e-9;
  const ContactShape at{Shape(Point{point})};
  SignedDistanceOptions how;
  how.at_most = near;
  std::optional<Vec3<double>> normal;
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t what = open.back();
    open.pop_back();
    const bool is_leaf = (what & BvhNode::leaf) != 0;
    const BvhNode& node =
        is_leaf ? BvhNode(mesh.boxes_of_leaf(what & ~BvhNode::leaf)) : mesh.bvh().nodes[what];
    for (int i = 0; i < bvh_width && node.children[i] != BvhNode::none; ++i) {
      if (!is_near(node, i, point, near)) continue;
      if (!is_leaf) {
        open.push_back(node.children[i]);
        continue;
      }
      const std::uint32_t part = node.children[i] & ~BvhNode::leaf;
      const TrianglePart triangle(mesh.corner(part, 0), mesh.corner(part, 1), mesh.corner(part, 2));
      if (signed_distance(at, {}, triangle.shape(), {}, how).lower > near) continue;
      const Vec3<double> its = mesh.normal(part);
      if (its.isZero(0)) continue;
      if (normal && (its - *normal).norm() > same_direction) return true;
      normal = its;
    }
  }
  return false;
}

}  // namespace minkray
