// SPDX-License-Identifier: MIT
// Points whose convex hull is a shape. Keeps only the extreme points.
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <vector>

#include "core/geometry/direction_table.h"
#include "core/geometry/facet_mesh.h"
#include "core/math/vec.h"

namespace minkray {

/// Immutable and shared: copies are cheap. Coplanar, collinear and single points are legal.
template <class T>
class PointCloud {
 public:
  PointCloud() = default;
  /// Requires at least one point; all points must be finite. `source` is the name of their mesh
  /// file, if any.
  explicit PointCloud(std::vector<Vec3<T>> points, std::string source = {});

  /// The extreme points, in the order in which they were given.
  const std::vector<Vec3<T>>& points() const { return *points_; }
  const std::string& source() const { return source_; }

  /// Null if the hull is flat up to rounding. Normals are computed before the points are rounded to
  /// T.
  const FacetMesh<T>* facets() const { return facets_.get(); }

  /// Rounds the points to U. Data computed from the points is shared, not computed again, so
  /// support points are maximal up to the rounding of the points.
  template <class U>
  PointCloud<U> cast() const {
    PointCloud<U> converted;
    auto points = std::make_shared<std::vector<Vec3<U>>>();
    points->reserve(points_->size());
    for (const Vec3<T>& p : *points_) points->push_back(p.template cast<U>());
    converted.points_ = std::move(points);
    converted.table_ = table_;
    if (facets_) converted.facets_ = converted.with_supports(facets_->template cast<U>());
    converted.source_ = source_;
    return converted;
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return support_where(Mask<W>(true), n);
  }

  /// Returns support points in the `wanted` lanes, and any of the points in others.
  template <class W>
  Vec3<W> support_where(const Mask<W>& wanted, const Vec3<W>& n) const {
    if constexpr (std::floating_point<W>)
      return (*points_)[wanted ? furthest(n, table_ ? table_->cell_of(n) : W(0)) : 0];
    else
      return table_ ? furthest_by_lane(wanted, n) : furthest_of_all(n);
  }

  std::size_t memory_bytes() const {
    return points_->capacity() * sizeof(Vec3<T>) + (table_ ? table_->memory_bytes() : 0) +
           (facets_ ? facets_->memory_bytes() : 0);
  }

 private:
  template <class U>
  friend class PointCloud;

  /// Returns the index of a point furthest along n; `cell` is the table's cell of n, if there is a
  /// table. Not inline, since packets of every instruction set call this function.
  std::size_t furthest(const Vec3<T>& n, T cell) const;

  /// Returns the facets with their supporting corners; null if no facet is supported.
  std::shared_ptr<const FacetMesh<T>> with_supports(FacetMesh<T> facets) const;

  /// Uses the table: each lane has its own list.
  template <class W>
  Vec3<W> furthest_by_lane(const Mask<W>& wanted, const Vec3<W>& n) const {
    const W cell = table_->cell_of(n);
    return per_lane<W>([&](int lane) {
      const Vec3<T> of_lane(n.x().lane(lane), n.y().lane(lane), n.z().lane(lane));
      return (*points_)[wanted.lane(lane) ? furthest(of_lane, cell.lane(lane)) : 0];
    });
  }

  /// For few points: scans all points for all lanes at once.
  template <class W>
  Vec3<W> furthest_of_all(const Vec3<W>& n) const {
    Vec3<W> best = widen<W>(points_->front());
    W furthest = n.dot(best);
    for (const Vec3<T>& point : *points_) {
      const Vec3<W> candidate = widen<W>(point);
      const W along = n.dot(candidate);
      const auto further = along > furthest;
      best = select<W>(further, candidate, best);
      furthest = select(further, along, furthest);
    }
    return best;
  }

  std::shared_ptr<const std::vector<Vec3<T>>> points_;
  std::shared_ptr<const DirectionTable> table_;  ///< null for few points: a scan is faster
  std::shared_ptr<const FacetMesh<T>> facets_;   ///< of solid hulls
  std::string source_;
};

extern template class PointCloud<float>;
extern template class PointCloud<double>;

}  // namespace minkray
