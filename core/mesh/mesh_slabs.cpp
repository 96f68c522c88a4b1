// SPDX-License-Identifier: MIT
#include "core/mesh/mesh_slabs.h"

#include <cmath>

#include "core/mesh/leaves_below.h"

namespace minkray {
namespace {

/// Area vectors, and the areas.
struct Areas {
  Vec3<double> vectors = Vec3<double>::Zero();
  double sum = 0;
};

Areas areas_of_leaf(const TriangleMesh& mesh, std::uint32_t leaf) {
  Areas areas;
  const MeshLeaf& of = mesh.leaves()[leaf];
  for (int i = 0; i < of.size(); ++i) {
    const std::uint32_t t = of.triangles[i];
    const Vec3<double> one =
        (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
    areas.vectors += one;
    areas.sum += one.norm();
  }
  return areas;
}

/// Calls each() for the corners below one child of a node.
template <class Each>
void each_corner(const TriangleMesh& mesh, std::uint32_t what, Each&& each) {
  each_leaf_below(mesh, what, [&](const MeshLeaf& leaf) {
    for (int i = 0; i < leaf.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) each(mesh.corner(leaf.triangles[i], k));
  });
}

void set_slab(NodeSlabs& slabs, int child, const TriangleMesh& mesh, std::uint32_t what,
              const Vec3<double>& n) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) slabs.normals[axis][child] = static_cast<float>(n[axis]);
  const Vec3<double> along = slabs.normal(child).cast<double>(), middle = mesh.bounds().centre();
  double low = infinity, high = -infinity;
  each_corner(mesh, what, [&](const Vec3<double>& corner) {
    const double height = along.dot(corner - middle);
    low = std::min(low, height);
    high = std::max(high, height);
  });
  slabs.low[child] = std::nextafter(static_cast<float>(low), -infinity);
  slabs.high[child] = std::nextafter(static_cast<float>(high), infinity);
}

}  // namespace

MeshSlabs::MeshSlabs(const TriangleMesh& mesh) {
  const auto& nodes = mesh.bvh().nodes;
  slabs_.resize(nodes.size());
  // Products of floats would leave their range.
  if (!mesh.suits_lanes()) return;
  /// Least ratio of the vector area to the area for a slab: below it a box is as thin.
  constexpr double flat_enough = 0.5;
  std::vector<Areas> of_nodes(nodes.size());
  // Children follow their parents.
  for (std::size_t i = nodes.size(); i-- > 0;) {
    for (int k = 0; k < bvh_width; ++k) {
      const std::uint32_t what = nodes[i].children[k];
      if (what == BvhNode::none) break;
      const Areas areas =
          (what & BvhNode::leaf) != 0 ? areas_of_leaf(mesh, what & ~BvhNode::leaf) : of_nodes[what];
      of_nodes[i].vectors += areas.vectors;
      of_nodes[i].sum += areas.sum;
      const double length = areas.vectors.norm();
      if (length > flat_enough * areas.sum)
        set_slab(slabs_[i], k, mesh, what, areas.vectors / length);
    }
  }
}

}  // namespace minkray
