// SPDX-License-Identifier: MIT
#include "core/parts/parts_reach.h"

#include <algorithm>

#include "core/pair/core_support.h"

namespace minkray {
namespace {

struct Furthest {
  double along = -std::numeric_limits<double>::infinity();
  Vec3<double> corner = Vec3<double>::Zero();
};

/// Corner of a mesh that is furthest along d, found with the boxes of its BVH.
Furthest furthest_corner(const TriangleMesh& mesh, const Vec3<double>& d) {
  // Capacity: the BVH has at most bvh_max_depth levels, with at most seven pending nodes per level.
  constexpr std::size_t room = bvh_max_depth * bvh_width;
  struct Open {
    double along;
    std::uint32_t what;
  } open[room];
  Furthest best;
  std::size_t count = 0;
  open[count++] = {std::numeric_limits<double>::infinity(), 0};
  while (count > 0) {
    const Open top = open[--count];
    if (!(top.along > best.along)) continue;
    if ((top.what & BvhNode::leaf) != 0) {
      const MeshLeaf& leaf = mesh.leaves()[top.what & ~BvhNode::leaf];
      for (int i = 0; i < leaf.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3<double>& corner = mesh.corner(leaf.triangles[i], k);
          const double along = d.dot(corner);
          if (along > best.along) best = {along, corner};
        }
      continue;
    }
    const BvhNode& node = mesh.bvh().nodes[top.what];
    const std::size_t first = count;
    for (int i = 0; i < bvh_width && node.children[i] != BvhNode::none; ++i) {
      double along = 0;
      for (int k = 0; k < 3; ++k)
        along += d[k] * static_cast<double>(node.planes[d[k] > 0 ? 1 : 0][k][i]);
      if (!(along > best.along)) continue;
      // Opens the node with the furthest reach first.
      std::size_t at = count++;
      for (; at > first && open[at - 1].along > along; --at) open[at] = open[at - 1];
      open[at] = {along, node.children[i]};
    }
  }
  return best;
}

/// Upper bound of n . p over the shape's points p, relative to its middle.
double reach_about_middle(const ContactShape& shape, const Mat3<double>& linear,
                          const Vec3<double>& n) {
  const Vec3<double> d = turn_in_world(shape, linear).transpose() * n;
  const ShapeCore& core = shape.core();
  return d.dot(support_of_core<CoreKind::other>(core, d).point) + core.radius +
         core_rounding * (core.ball + core.radius) + core.rounding;
}

}  // namespace

double reach_along(const PartsBody& body, const Mat3<double>& linear, const Vec3<double>& n) {
  if (body.shape()) return reach_about_middle(*body.shape(), linear, n);
  if (const Compound* const compound = body.compound()) {
    const Vec3<double> middle = middle_of(body);
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < compound->size(); ++i) {
      const ContactShape& part = compound->contact(i);
      const Vec3<double> from_middle =
          (part.exact_middle() - TwoFoldVec3<double>(middle)).rounded();
      most = std::max(most, n.dot(linear * from_middle) + reach_about_middle(part, linear, n));
    }
    return most + core_rounding * compound->reach();
  }
  const TriangleMesh& mesh = *body.mesh();
  const Vec3<double> d = linear.transpose() * n;
  return furthest_corner(mesh, d).along - d.dot(middle_of(body)) + core_rounding * mesh.reach();
}

SignedDistance distance_to_half_space(const PlacedPlane& plane, const PartsBody& body,
                                      const Affine<double>& pose) {
  if (body.shape())
    return distance_to_half_space(plane, *body.shape(), pose.linear,
                                  placed_middle(*body.shape(), pose));
  if (const Compound* const compound = body.compound()) {
    SignedDistance nearest;
    for (std::size_t i = 0; i < compound->size(); ++i) {
      const ContactShape& part = compound->contact(i);
      const SignedDistance found =
          distance_to_half_space(plane, part, pose.linear, placed_middle(part, pose));
      if (found.is_unknown()) return found;
      const double lower = i == 0 ? found.lower : std::min(nearest.lower, found.lower);
      if (i == 0 || found.value < nearest.value) nearest = found;
      nearest.lower = lower;
    }
    return nearest;
  }
  const TriangleMesh& mesh = *body.mesh();
  const Vec3<double> along = pose.linear.transpose() * plane.normal;
  const Vec3<double> from_plane = (TwoFoldVec3<double>(pose.translation) - plane.point).rounded();
  const Furthest lowest = furthest_corner(mesh, -along);
  const double rounding = core_rounding * (from_plane.norm() + mesh.reach());
  SignedDistance found;
  found.value = plane.normal.dot(from_plane) - lowest.along;
  found.lower = found.value - rounding;
  found.upper = found.value + rounding;
  found.status = found.lower > 0   ? SignedStatus::separated
                 : found.upper < 0 ? SignedStatus::overlapping
                                   : SignedStatus::touching;
  found.normal = plane.normal;
  found.point_b = pose(lowest.corner);
  found.point_a = found.point_b - found.value * plane.normal;
  return found;
}

}  // namespace minkray
