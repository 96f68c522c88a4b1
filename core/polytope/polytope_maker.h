// SPDX-License-Identifier: MIT
// Fills a polytope's tables: triangles and their neighbours, planes that support all points, and a
// map from directions to triangles. Only polytope.cpp includes this file.
#pragma once

#include <algorithm>
#include <numeric>

#include "core/polytope/polytope.h"
#include "core/query/tolerances.h"

namespace minkray::exact {

/// Fills the tables of a polytope: first the triangles, then the planes, then all the rest.
class Polytope::Maker {
 public:
  Maker(Polytope& made, std::vector<Vec3<double>> vertices)
      : made_(made), vertices_(std::move(vertices)) {}

  /// Stores the mesh's triangles. Returns false if the links between neighbours are not mutual.
  template <class T>
  bool take_triangles(const FacetMesh& mesh, const std::vector<Vec3<T>>& points) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto at = [&](std::uint32_t i) {
      return Vec3<double>(points[i].template cast<double>());
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return is_before(at(a), at(b)); });
    const auto index_of = [&](const Vec3<T>& corner) {
      const auto found = std::lower_bound(
          order.begin(), order.end(), Vec3<double>(corner.template cast<double>()),
          [&](std::uint32_t i, const Vec3<double>& p) { return is_before(at(i), p); });
      return found == order.end() ? order.front() : *found;
    };
    triangles_.resize(mesh.size());
    for (std::size_t f = 0; f < mesh.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) triangles_[f].corner[k] = index_of(mesh[f].corner(k));
    for (std::size_t f = 0; f < mesh.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        if (!link(f, k, mesh[f].neighbour(k))) return false;
    return true;
  }

  /// Stores the two sides of a single triangle, each with its own plane.
  void take_two_sides() {
    triangles_ = {{{0, 1, 2}, {5, 4, 3}}, {{0, 2, 1}, {2, 1, 0}}};
    for (std::uint32_t side = 0; side < 2; ++side) {
      planes_.push_back(supporting(unit<double>(normal_of(triangles_[side]))));
      depths_.push_back(depth_of(planes_[side], triangles_[side]));
      plane_of_.push_back(side);
    }
    made_.tables_.inner = (vertices_[0] + vertices_[1] + vertices_[2]) / 3;
  }

  /// Finds the planes, beginning with the largest triangles, so that slivers use planes of larger
  /// neighbours.
  void find_planes() {
    own_.resize(triangles_.size());
    std::vector<double> areas(triangles_.size());
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      const Vec3<double> across = normal_of(triangles_[f]);
      areas[f] = across.norm();
      own_[f] = supporting(unit<double>(across));
    }
    std::vector<std::size_t> order(triangles_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
    plane_of_.assign(triangles_.size(), none);
    for (const std::size_t f : order) choose_plane(f);
  }

  /// Finds the points' mean. Returns true if the mean lies below all planes moved inwards by their
  /// depths, as the proof of the error bound requires.
  bool find_inside() {
    Vec3<Long> mean = Vec3<Long>::Zero();
    for (const Vec3<double>& p : vertices_) mean += p.cast<Long>();
    mean /= static_cast<Long>(vertices_.size());
    made_.tables_.inner = mean.cast<double>();
    for (std::size_t i = 0; i < planes_.size(); ++i)
      if (!(planes_[i].normal.cast<Long>().dot(mean) <
            planes_[i].offset - 2 * (depths_[i] + made_.rounding_)))
        return false;
    return true;
  }

  void fill_tables() {
    PolytopeTables& tables = made_.tables_;
    for (const Vec3<double>& p : vertices_) append(tables.vertices, {p.x(), p.y(), p.z(), 0});
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const Vec3<double>& n = planes_[i].normal;
      const double offset = static_cast<double>(planes_[i].offset);
      const double depth = static_cast<double>(depths_[i]);
      tables.scanned.add(n, offset, depth);
      append(tables.planes, {n.x(), n.y(), n.z(), offset, depth, 0, 0, 0});
    }
    for (std::size_t f = 0; f < triangles_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t twin = triangles_[f].twin[k], after = next(twin);
        const Vec3<double>& far = vertices_[origin(next(after))];
        const double link = after % 3 == 2 ? -static_cast<double>(after) : after;
        append(tables.walk, {far.x(), far.y(), far.z(), link});
        tables.links.push_back(static_cast<std::int32_t>(link));
        tables.origin.push_back(triangles_[f].corner[k]);
        tables.plane_of.push_back(plane_of_[f]);
        if (tables.rounded_by > 0) fill_feature(static_cast<std::uint32_t>(3 * f + k), twin);
      }
  }

  /// Fills the map from directions to triangles; facing(n) returns a triangle whose normal is near
  /// n.
  template <class Facing>
  void fill_map(const Facing& facing) {
    PolytopeTables& tables = made_.tables_;
    tables.directions =
        CubeMap(std::min(cells_a_triangle * static_cast<double>(triangles_.size()), most_cells));
    tables.facing.resize(tables.directions.cells());
    for (std::size_t i = 0; i < tables.facing.size(); ++i) {
      const CubeMap::Cell cell = tables.directions[i];
      Vec3<double> middle;
      middle[cell.axis] = cell.sign;
      middle[(cell.axis + 1) % 3] = cell.u + cell.width / 2;
      middle[(cell.axis + 2) % 3] = cell.v + cell.width / 2;
      tables.facing[i] = static_cast<std::uint32_t>(3 * facing(middle));
    }
  }

  /// Adds the radius, and the rounding that makes adjacent features ambiguous (docs/forms.md).
  /// Returns false if the polytope is not convex or has triangles whose height is too small.
  bool make_room_for_rounding() {
    Long least = made_.radius_;
    for (const Triangle& triangle : triangles_) {
      std::array<Vec3<Long>, 3> p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = vertices_[triangle.corner[k]].cast<Long>();
      const Vec3<Long> across = (p[1] - p[0]).cross(p[2] - p[0]);
      Long longest = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        longest = std::max(longest, (p[(k + 1) % 3] - p[k]).norm());
        const Vec3<Long> other = vertices_[origin(next(next(triangle.twin[k])))].cast<Long>();
        if (across.dot(other - p[0]) > across.norm() * Long(made_.rounding_) / 2) return false;
      }
      if (!(longest > 0)) return false;
      least = std::min(least, across.norm() / longest);
    }
    const double room = static_cast<double>(least) / made_.radius_;
    if (!(room > tolerance::rounded_polytope_height)) return false;
    // A feature that seems to fall away may in fact rise due to rounding: by no more than rounding
    // if the feature is adjacent, and by proportionally more if it is further away.
    made_.radius_ += made_.tables_.rounded_by;
    made_.rounding_ = tolerance::polytope_rounding * made_.radius_ + 2 * made_.rounding_ / room;
    return true;
  }

 private:
  using Long = long double;

  /// Cells per triangle in the map of normals, and the number of cells that fit in the cache.
  static constexpr double cells_a_triangle = 4, most_cells = 6 * 64 * 64;

  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// A plane with all points of the hull below it.
  struct Plane {
    Vec3<double> normal = Vec3<double>::Zero();
    Long offset = 0;
  };

  static bool is_before(const Vec3<double>& a, const Vec3<double>& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }

  /// Corners counter-clockwise from outside. `twin` has, for the half-edge from each corner, its
  /// twin: the same edge in the neighbouring triangle.
  struct Triangle {
    std::array<std::uint32_t, 3> corner, twin;
  };

  static void append(std::vector<double>& table, std::initializer_list<double> row) {
    table.insert(table.end(), row);
  }
  /// The half-edge after this one in its triangle.
  static std::uint32_t next(std::uint32_t half_edge) {
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
  }
  std::uint32_t origin(std::uint32_t half_edge) const {
    return triangles_[half_edge / 3].corner[half_edge % 3];
  }

  bool link(std::size_t f, std::size_t k, std::size_t other) {
    const auto& corner = triangles_[f].corner;
    const auto& beyond = triangles_[other].corner;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (beyond[edge] != corner[(k + 1) % 3] || beyond[(edge + 1) % 3] != corner[k]) continue;
      triangles_[f].twin[k] = static_cast<std::uint32_t>(3 * other + edge);
      return other != f;
    }
    return false;
  }

  /// Rounds unit vectors only once, so that slender triangles keep their digits.
  void fill_feature(std::uint32_t half_edge, std::uint32_t twin) {
    const std::uint32_t after = next(half_edge);
    const Vec3<double>& a = vertices_[origin(half_edge)];
    const Vec3<Long> from = a.cast<Long>();
    const Vec3<Long> along = vertices_[origin(after)].cast<Long>() - from;
    const Vec3<Long> across = vertices_[origin(next(after))].cast<Long>() - from;
    const Long length = along.norm();
    const Vec3<double> u = (along / length).cast<double>();
    const Vec3<double> inwards =
        (across - along * (across.dot(along) / along.squaredNorm())).normalized().cast<double>();
    append(made_.tables_.features,
           {a.x(), a.y(), a.z(), static_cast<double>(after), inwards.x(), inwards.y(), inwards.z(),
            static_cast<double>(twin), u.x(), u.y(), u.z(), static_cast<double>(length)});
  }

  /// Uses the shorter edges, since these have the least rounding.
  Vec3<double> normal_of(const Triangle& triangle) const {
    const Vec3<double>&a = vertices_[triangle.corner[0]], &b = vertices_[triangle.corner[1]],
          &c = vertices_[triangle.corner[2]];
    const Vec3<double> ab = b - a, bc = c - b, ac = c - a;
    return ab.squaredNorm() < bc.squaredNorm() ? ab.cross(ac) : ac.cross(bc);
  }

  Plane supporting(const Vec3<double>& normal) const {
    Plane plane{normal, -std::numeric_limits<Long>::infinity()};
    // Points that are clearly lower in double are not computed in long double.
    double furthest = -std::numeric_limits<double>::infinity();
    const double unsure = 2 * made_.rounding_;
    for (const Vec3<double>& p : vertices_) {
      const double along = normal.dot(p);
      if (along < furthest - unsure) continue;
      furthest = std::max(furthest, along);
      plane.offset = std::max(plane.offset, height(normal, p));
    }
    return plane;
  }

  static Long height(const Vec3<double>& normal, const Vec3<double>& p) {
    return normal.cast<Long>().dot(p.cast<Long>());
  }

  /// Depth of the lowest corner below the plane.
  Long depth_of(const Plane& plane, const Triangle& triangle) const {
    Long lowest = plane.offset;
    for (const std::uint32_t corner : triangle.corner)
      lowest = std::min(lowest, height(plane.normal, vertices_[corner]));
    return plane.offset - lowest;
  }

  /// Uses a neighbour's plane for the triangle if the corners are as near to the neighbour's plane
  /// as to the triangle's own, or if their distance from the neighbour's plane is within rounding.
  void choose_plane(std::size_t f) {
    const Triangle& triangle = triangles_[f];
    const bool has_normal = own_[f].normal.squaredNorm() > 0;
    Long least = has_normal ? std::max(depth_of(own_[f], triangle), Long(made_.rounding_))
                            : std::numeric_limits<Long>::infinity();
    for (const std::uint32_t twin : triangle.twin) {
      const std::uint32_t plane = plane_of_[twin / 3];
      if (plane == none) continue;
      const Long depth = depth_of(planes_[plane], triangle);
      if (!(depth <= least)) continue;
      least = depth;
      plane_of_[f] = plane;
    }
    if (plane_of_[f] == none) {
      plane_of_[f] = static_cast<std::uint32_t>(planes_.size());
      planes_.push_back(own_[f]);
      depths_.push_back(0);
    }
    Long& depth = depths_[plane_of_[f]];
    depth = std::max(depth, depth_of(planes_[plane_of_[f]], triangle));
  }

  Polytope& made_;
  std::vector<Vec3<double>> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Plane> own_, planes_;  ///< planes of each triangle; planes that are kept
  std::vector<Long> depths_;
  std::vector<std::uint32_t> plane_of_;
};

}  // namespace minkray::exact
