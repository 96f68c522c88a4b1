// SPDX-License-Identifier: MIT
#include "core/parts/bends.h"

#include <algorithm>
#include <optional>
#include <utility>

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

double distance_to_segment(const Vec3<double>& point, const Vec3<double>& p,
                           const Vec3<double>& q) {
  const Vec3<double> way = q - p;
  const double squared = way.squaredNorm();
  const double part = squared > 0 ? std::clamp((point - p).dot(way) / squared, 0.0, 1.0) : 0;
  return (p + part * way - point).norm();
}

/// Edges near a point that an odd number of triangles have.
class OpenEdges {
 public:
  OpenEdges(const TriangleMesh& mesh, const Vec3<double>& point, double near)
      : mesh_(mesh), point_(point), near_(near) {}

  void add(std::uint32_t part) {
    for (std::size_t k = 0; k < 3; ++k) {
      Edge edge{mesh_.corner(part, k), mesh_.corner(part, (k + 1) % 3)};
      // The order in which both triangles compute the same distance.
      if (is_before(edge.second, edge.first)) std::swap(edge.first, edge.second);
      if (distance_to_segment(point_, edge.first, edge.second) > near_) continue;
      const auto known = std::ranges::find(odd_, edge);
      if (known == odd_.end())
        odd_.push_back(edge);
      else
        odd_.erase(known);
    }
  }
  bool any() const { return !odd_.empty(); }

 private:
  using Edge = std::pair<Vec3<double>, Vec3<double>>;
  static bool is_before(const Vec3<double>& p, const Vec3<double>& q) {
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  }

  const TriangleMesh& mesh_;
  const Vec3<double>& point_;
  double near_;
  std::vector<Edge> odd_;
};

}  // namespace

bool bends_or_ends_at(const TriangleMesh& mesh, const Vec3<double>& point, double near) {
  constexpr double same_direction = 1e-9;
  const ContactShape at{Shape(Point{point})};
  // Includes both triangles of an edge that is `near`, in spite of rounding.
  const double around = 1.5 * near;
  SignedDistanceOptions how;
  how.at_most = around;
  OpenEdges open_edges(mesh, point, near);
  std::optional<Vec3<double>> normal;
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t what = open.back();
    open.pop_back();
    const bool is_leaf = (what & BvhNode::leaf) != 0;
    const BvhNode& node =
        is_leaf ? BvhNode(mesh.boxes_of_leaf(what & ~BvhNode::leaf)) : mesh.bvh().nodes[what];
    for (int i = 0; i < bvh_width && node.children[i] != BvhNode::none; ++i) {
      if (!is_near(node, i, point, around)) continue;
      if (!is_leaf) {
        open.push_back(node.children[i]);
        continue;
      }
      const std::uint32_t part = node.children[i] & ~BvhNode::leaf;
      const TrianglePart triangle(mesh.corner(part, 0), mesh.corner(part, 1), mesh.corner(part, 2));
      if (signed_distance(at, {}, triangle.shape(), {}, how).lower > around) continue;
      open_edges.add(part);
      const Vec3<double> its = mesh.normal(part);
      if (its.isZero(0)) continue;
      if (normal && (its - *normal).norm() > same_direction) return true;
      normal = its;
    }
  }
  return open_edges.any();
}

}  // namespace minkray
