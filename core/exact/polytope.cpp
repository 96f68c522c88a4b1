// SPDX-License-Identifier: MIT
#include "core/exact/polytope.h"

#include <algorithm>
#include <numeric>

#include "core/query/tolerances.h"

namespace minkray::exact {
namespace {

using Long = long double;

/// Every plane is measured at every point: more would take longer than a second to prepare.
constexpr std::size_t most_points = 4096;

/// Cells of the map of normals a triangle, and cells that fit the cache.
constexpr double cells_a_triangle = 4, most_cells = 6 * 64 * 64;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// A plane beyond which no point of the hull lies.
struct Plane {
  Vec3<double> normal = Vec3<double>::Zero();
  Long offset = 0;
};

bool is_before(const Vec3<double>& a, const Vec3<double>& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

}  // namespace

/// Fills in a polytope.
class Polytope::Maker {
 public:
  explicit Maker(Polytope& made) : made_(made) {}

  /// False, if triangles are not each other's neighbours.
  template <class T>
  bool take_triangles(const FacetMesh<T>& mesh, const std::vector<Vec3<T>>& points) {
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
    made_.triangles_.resize(mesh.size());
    for (std::size_t f = 0; f < mesh.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        made_.triangles_[f].corner[k] = index_of(mesh[f].corner(k));
    for (std::size_t f = 0; f < mesh.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        if (!link(f, k, mesh[f].neighbour(k))) return false;
    return true;
  }

  /// The planes, first of the largest triangles, so that slivers have others' planes.
  void find_planes() {
    const auto& triangles = made_.triangles_;
    own_.resize(triangles.size());
    std::vector<double> areas(triangles.size());
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      const Vec3<double> across = normal_of(triangles[f]);
      areas[f] = across.norm();
      own_[f] = supporting(unit<double>(across));
    }
    std::vector<std::size_t> order(triangles.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
    plane_of_.assign(triangles.size(), none);
    for (const std::size_t f : order) choose_plane(f);
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const double offset = static_cast<double>(planes_[i].offset);
      made_.planes_.add(planes_[i].normal, offset, static_cast<double>(depths_[i]));
    }
    for (std::size_t f = 0; f < triangles.size(); ++f) made_.triangles_[f].plane = plane_of_[f];
  }

  /// Finds the points' mean, and whether it lies within all planes, moved in by their depths: else
  /// the proof has nothing to begin with.
  bool find_inside() {
    Vec3<Long> mean = Vec3<Long>::Zero();
    for (const Vec3<double>& p : made_.vertices_) mean += p.cast<Long>();
    mean /= static_cast<Long>(made_.vertices_.size());
    made_.inner_ = mean.cast<double>();
    for (std::size_t i = 0; i < planes_.size(); ++i)
      if (!(planes_[i].normal.cast<Long>().dot(mean) <
            planes_[i].offset - 2 * (depths_[i] + made_.rounding_)))
        return false;
    return true;
  }

  template <class T>
  void fill_map(const FacetMesh<T>& mesh) {
    made_.directions_ = CubeMap(
        std::min(cells_a_triangle * static_cast<double>(made_.triangles_.size()), most_cells));
    made_.facing_.resize(made_.directions_.cells());
    for (std::size_t i = 0; i < made_.facing_.size(); ++i) {
      const CubeMap::Cell cell = made_.directions_[i];
      Vec3<T> middle;
      middle[cell.axis] = static_cast<T>(cell.sign);
      middle[(cell.axis + 1) % 3] = static_cast<T>(cell.u + cell.width / 2);
      middle[(cell.axis + 2) % 3] = static_cast<T>(cell.v + cell.width / 2);
      made_.facing_[i] = static_cast<std::uint32_t>(mesh.template facing<T>(middle));
    }
  }

  /// What makes the polytope fit to be rounded (docs/theory.md).
  void look_at_pieces() {
    Long least = made_.radius_;
    for (const Triangle& triangle : made_.triangles_) {
      std::array<Vec3<Long>, 3> p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = made_.vertices_[triangle.corner[k]].cast<Long>();
      const Vec3<Long> across = (p[1] - p[0]).cross(p[2] - p[0]);
      Long longest = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        longest = std::max(longest, (p[(k + 1) % 3] - p[k]).norm());
        const std::uint32_t beyond = triangle.beyond[k];
        const Vec3<Long> other =
            made_.vertices_[made_.triangles_[beyond / 4].corner[(beyond % 4 + 2) % 3]].cast<Long>();
        if (across.dot(other - p[0]) > across.norm() * Long(made_.rounding_) / 2) return;
      }
      if (!(longest > 0)) return;
      least = std::min(least, across.norm() / longest);
    }
    const double room = static_cast<double>(least) / made_.radius_;
    if (room > tolerance::rounded_polytope_height) made_.room_for_rounding_ = room;
  }

 private:
  bool link(std::size_t f, std::size_t k, std::size_t other) {
    const auto& corner = made_.triangles_[f].corner;
    const auto& beyond = made_.triangles_[other].corner;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      if (beyond[edge] != corner[(k + 1) % 3] || beyond[(edge + 1) % 3] != corner[k]) continue;
      made_.triangles_[f].beyond[k] = static_cast<std::uint32_t>(4 * other + edge);
      return other != f;
    }
    return false;
  }

  /// Goes by way of the shorter edges, whose rounding is least.
  Vec3<double> normal_of(const Triangle& triangle) const {
    const Vec3<double>&a = made_.vertices_[triangle.corner[0]],
          &b = made_.vertices_[triangle.corner[1]], &c = made_.vertices_[triangle.corner[2]];
    const Vec3<double> ab = b - a, bc = c - b, ac = c - a;
    return ab.squaredNorm() < bc.squaredNorm() ? ab.cross(ac) : ac.cross(bc);
  }

  Plane supporting(const Vec3<double>& normal) const {
    Plane plane{normal, -std::numeric_limits<Long>::infinity()};
    // What is clearly less in double need not be known better.
    double furthest = -std::numeric_limits<double>::infinity();
    const double unsure = 2 * made_.rounding_;
    for (const Vec3<double>& p : made_.vertices_) {
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

  /// How far the lowest corner is below the plane.
  Long depth_of(const Plane& plane, const Triangle& triangle) const {
    Long lowest = plane.offset;
    for (const std::uint32_t corner : triangle.corner)
      lowest = std::min(lowest, height(plane.normal, made_.vertices_[corner]));
    return plane.offset - lowest;
  }

  /// A neighbour's, if its corners lie as near to that as rounding or as to the triangle's own.
  void choose_plane(std::size_t f) {
    const Triangle& triangle = made_.triangles_[f];
    const bool has_normal = own_[f].normal.squaredNorm() > 0;
    Long least = has_normal ? std::max(depth_of(own_[f], triangle), Long(made_.rounding_))
                            : std::numeric_limits<Long>::infinity();
    for (const std::uint32_t beyond : triangle.beyond) {
      const std::uint32_t plane = plane_of_[beyond / 4];
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
  std::vector<Plane> own_, planes_;  ///< of each triangle; those that are kept
  std::vector<Long> depths_;
  std::vector<std::uint32_t> plane_of_;
};

template <class T>
std::shared_ptr<const Polytope> Polytope::of(const PointCloud<T>& points,
                                             const Vec3<double>& middle, double down) {
  const FacetMesh<T>* mesh = points.facets();
  if (!mesh || points.points().size() > most_points) return nullptr;
  const std::shared_ptr<Polytope> made(new Polytope());
  Vec3<double> extents = Vec3<double>::Zero();
  for (const Vec3<T>& point : points.points()) {
    made->vertices_.push_back(point.template cast<double>() * down - middle);
    made->radius_ = std::max(made->radius_, made->vertices_.back().norm());
    extents = extents.cwiseMax(made->vertices_.back().cwiseAbs());
  }
  made->radius_ *= 1 + 4 * std::numeric_limits<double>::epsilon();
  made->rounding_ = tolerance::polytope_rounding * made->radius_;
  made->by_extents_ =
      extents.cwiseMax(Vec3<double>::Constant(extents.maxCoeff() / 65536)).cwiseInverse();
#if defined(__x86_64__)
  made->has_avx2_ = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
  Maker maker(*made);
  if (!maker.take_triangles(*mesh, points.points())) return nullptr;
  maker.find_planes();
  if (!maker.find_inside()) return nullptr;
  maker.fill_map(*mesh);
  maker.look_at_pieces();
  return made;
}

template std::shared_ptr<const Polytope> Polytope::of(const PointCloud<float>&, const Vec3<double>&,
                                                      double);
template std::shared_ptr<const Polytope> Polytope::of(const PointCloud<double>&,
                                                      const Vec3<double>&, double);

}  // namespace minkray::exact
