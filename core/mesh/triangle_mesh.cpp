// SPDX-License-Identifier: MIT
#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/bvh/leaves.h"
#include "core/math/two_fold.h"
#include "core/mesh/weld.h"
#include "core/parallel/parallel.h"

namespace minkray {
namespace {

constexpr std::size_t most_triangles = std::size_t{1} << 30;

/// Limits such that products of three coordinates and their last digits stay in the range of
/// double.
constexpr double largest_coordinate = 0x1p300, smallest_size = 0x1p-250;

constexpr std::size_t triangles_a_range = 4096;

/// Squares of such numbers have all their digits.
constexpr double ordinary = 0x1p-200;

/// Limits of meshes for lanes: products of float coordinates and scales stay far from the limits of
/// float.
constexpr double largest_of_lanes = 0x1p60, smallest_of_lanes = 0x1p-60;

/// Corners in units of a leaf are less than 2^16, also when the scale has lost its last bits.
constexpr double units_of_leaf = 65530;

/// A leaf whose triangles lie in one point has a cube of this share of the mesh.
constexpr double least_leaf = 0x1p-40;

constexpr std::size_t leaves_a_range = 512;

TwoFold<double> operator-(const TwoFold<double>& a, const TwoFold<double>& b) {
  return a + TwoFold<double>{-b.high, -b.low};
}

/// Fills in the corners of the leaf's triangles; `size` is that of the whole mesh.
void fit_corners(MeshLeaf& leaf, const TriangleMesh& mesh, double size) {
  const auto count = static_cast<std::size_t>(leaf.size());
  Bounds<double> box;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) box.extend(mesh.corner(leaf.triangles[i], k));
  const Bounds<float> rounded = rounded_outwards(box);
  double extent = least_leaf * size;
  for (int axis = 0; axis < 3; ++axis) {
    leaf.origin[axis] = rounded.lower[axis];
    extent = std::max(extent, box.upper[axis] - double{rounded.lower[axis]});
  }
  const auto scale = std::bit_cast<std::uint32_t>(static_cast<float>(units_of_leaf / extent));
  leaf.packed_scale = ((scale - 8) & ~7u) | leaf.packed_scale;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<double>& corner = mesh.corner(leaf.triangles[i], k);
      for (std::size_t axis = 0; axis < 3; ++axis)
        leaf.corners[k][axis][i] = static_cast<std::uint16_t>(
            (corner[static_cast<int>(axis)] - double{leaf.origin[axis]}) * double{leaf.scale()} +
            0.5);
    }
}

[[noreturn]] void wrong(const std::string& what) {
  throw std::invalid_argument(what);
}

}  // namespace

TriangleMesh::TriangleMesh(std::vector<Vec3<double>> vertices, std::vector<Corners> triangles,
                           MeshSides sides)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)), sides_(sides) {
  if (triangles_.empty()) wrong("triangles: must be at least one (got none)");
  if (triangles_.size() > most_triangles)
    wrong("triangles: must be at most 2^30 (got " + std::to_string(triangles_.size()) + ")");
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    if (!vertices_[i].allFinite() || vertices_[i].cwiseAbs().maxCoeff() > largest_coordinate)
      wrong("vertices[" + std::to_string(i) + "]: must be finite and at most 2^300");
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    for (const std::uint32_t vertex : triangles_[i]) {
      if (vertex < vertices_.size()) continue;
      wrong("triangles[" + std::to_string(i) + "]: must be numbers of vertices, less than " +
            std::to_string(vertices_.size()) + " (got " + std::to_string(vertex) + ")");
    }
  FirstTouchVector<Bounds<float>> boxes;
  boxes.resize(triangles_.size());
  parallel_for(triangles_.size(), triangles_a_range, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Bounds<double> box;
      for (const std::uint32_t vertex : triangles_[i]) box.extend(vertices_[vertex]);
      boxes[i] = rounded_outwards(box);
    }
  });
  for (const Corners& triangle : triangles_)
    for (const std::uint32_t vertex : triangle) {
      bounds_.extend(vertices_[vertex]);
      reach_ = std::max(reach_, vertices_[vertex].norm());
    }
  reach_ *= 1 + 8 * std::numeric_limits<double>::epsilon();
  if (!(Vec3<double>(bounds_.upper - bounds_.lower).maxCoeff() >= smallest_size))
    wrong("vertices: must be further apart than 2^-250");
  BvhOfLeaves built = build_bvh_of_leaves(std::move(boxes));
  bvh_ = std::move(built.bvh);
  const double size = (bounds_.upper - bounds_.lower).maxCoeff();
  const double furthest = bounds_.lower.cwiseAbs().cwiseMax(bounds_.upper.cwiseAbs()).maxCoeff();
  suits_lanes_ = furthest <= largest_of_lanes && size >= smallest_of_lanes;
  leaves_.resize(built.begins.size() - 1);
  parallel_for(leaves_.size(), leaves_a_range, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      MeshLeaf& leaf = leaves_[i];
      leaf = {};
      const std::uint32_t from = built.begins[i], count = built.begins[i + 1] - from;
      leaf.packed_scale = count - 1;
      for (std::uint32_t k = 0; k < count; ++k) leaf.triangles[k] = built.boxes[from + k];
      if (suits_lanes_) fit_corners(leaf, *this, size);
    }
  });
}

BvhNode TriangleMesh::boxes_of_leaf(std::uint32_t number) const {
  const MeshLeaf& leaf = leaves_[number];
  BvhNode node;
  for (int i = 0; i < bvh_width; ++i) {
    if (i >= leaf.size()) {
      node.set(i, {}, BvhNode::none);
      continue;
    }
    Bounds<double> box;
    for (std::size_t k = 0; k < 3; ++k) box.extend(corner(leaf.triangles[i], k));
    node.set(i, rounded_outwards(box), BvhNode::leaf | leaf.triangles[i]);
  }
  return node;
}

Vec3<double> TriangleMesh::normal(std::uint32_t triangle) const {
  const Vec3<double> a = corner(triangle, 1) - corner(triangle, 0),
                     b = corner(triangle, 2) - corner(triangle, 0), plain = a.cross(b);
  constexpr double wide = 1e-2;  // the square of a sine
  const double squared = plain.squaredNorm(), of_sides = a.squaredNorm() * b.squaredNorm();
  if (squared >= wide * of_sides && squared > ordinary && of_sides < 1 / ordinary)
    return plain / std::sqrt(squared);
  // The two products are nearly equal for a sliver: their difference needs more digits.
  const TwoFoldVec3<double> p = exact_difference(corner(triangle, 1), corner(triangle, 0)),
                            q = exact_difference(corner(triangle, 2), corner(triangle, 0));
  Vec3<double> n;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const TwoFold<double> difference = p[i] * q[j] - p[j] * q[i];
    n[k] = difference.high + difference.low;
  }
  const double largest = n.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return Vec3<double>::Zero();
  return (n / largest).normalized();
}

MeshFaults TriangleMesh::faults() const {
  MeshFaults faults;
  // An edge from a lower to a higher number counts up, one the other way down.
  struct Edge {
    std::uint32_t from, to;
    int way;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * triangles_.size());
  const std::vector<std::uint32_t> place = first_at_place(vertices_);
  // The least vertex is first, so that repeats are equal.
  std::vector<Corners> turned(triangles_);
  for (Corners& triangle : turned) {
    for (std::uint32_t& corner : triangle) corner = place[corner];
    std::ranges::rotate(triangle, std::ranges::min_element(triangle));
  }
  for (std::uint32_t i = 0; i < turned.size(); ++i)
    faults.without_area += normal(i).isZero(0) ? 1 : 0;
  std::ranges::sort(turned);
  const std::size_t size = turned.size();
  turned.erase(std::ranges::unique(turned).begin(), turned.end());
  for (const Corners& t : turned)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      if (from == to) continue;
      edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  for (Corners& triangle : turned) std::ranges::sort(triangle);
  std::ranges::sort(turned);
  faults.repeated = size - turned.size();
  for (std::size_t i = 1; i < turned.size(); ++i)
    faults.repeated += turned[i] == turned[i - 1] ? 1 : 0;
  std::ranges::sort(edges, {}, [](const Edge& e) { return std::pair(e.from, e.to); });
  for (std::size_t i = 0; i < edges.size();) {
    int balance = 0;
    std::size_t end = i;
    for (; end < edges.size() && edges[end].from == edges[i].from && edges[end].to == edges[i].to;
         ++end)
      balance += edges[end].way;
    faults.open_edges += balance != 0 ? 1 : 0;
    i = end;
  }
  return faults;
}

bool TriangleMesh::is_closed() const {
  std::call_once(closed_once_, [this] { is_closed_ = faults().is_closed(); });
  return is_closed_;
}

const MeshSlabs& TriangleMesh::slabs() const {
  std::call_once(slabs_once_, [this] { slabs_ = std::make_unique<const MeshSlabs>(*this); });
  return *slabs_;
}

std::size_t TriangleMesh::bytes() const {
  return vertices_.capacity() * sizeof(vertices_[0]) +
         triangles_.capacity() * sizeof(triangles_[0]) + bvh_.bytes() +
         leaves_.capacity() * sizeof(leaves_[0]);
}

}  // namespace minkray
