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
class PointCloud {
 public:
  PointCloud() = default;
  /// Requires at least one point; all points must be finite. `source` is the name of the mesh file
  /// that the points are from, if any.
  explicit PointCloud(std::vector<Vec3<double>> points, std::string source = {});

  /// The extreme points, in the order in which they were given.
  const std::vector<Vec3<double>>& points() const { return *points_; }
  const std::string& source() const { return source_; }

  /// Null if the hull is flat up to rounding.
  const FacetMesh* facets() const { return facets_.get(); }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return support_where(Mask<W>(true), n);
  }

  /// Returns support points in the `wanted` lanes, and any point of the cloud in the other lanes.
  template <class W>
  Vec3<W> support_where(const Mask<W>& wanted, const Vec3<W>& n) const {
    if constexpr (std::floating_point<W>)
      return widen<W>((*points_)[wanted ? furthest(n, table_ ? table_->cell_of(n) : W(0)) : 0]);
    else
      return table_ ? furthest_by_lane(wanted, n) : furthest_of_all(n);
  }

  std::size_t memory_bytes() const {
    return points_->capacity() * sizeof(Vec3<double>) + (table_ ? table_->memory_bytes() : 0) +
           (facets_ ? facets_->memory_bytes() : 0);
  }

 private:
  /// Returns the index of a point furthest along n; `cell` is the table's cell of n, if there is a
  /// table. Not inline, since packets of every instruction set call this function.
  template <std::floating_point W>
  std::size_t furthest(const Vec3<W>& n, W cell) const;

  /// Uses the table: each lane has its own list.
  template <class W>
  Vec3<W> furthest_by_lane(const Mask<W>& wanted, const Vec3<W>& n) const {
    const W cell = table_->cell_of(n);
    return per_lane<W>([&](int lane) {
      const Vec3<double> of_lane(n.x().lane(lane), n.y().lane(lane), n.z().lane(lane));
      return (*points_)[wanted.lane(lane) ? furthest(of_lane, cell.lane(lane)) : 0];
    });
  }

  /// For few points: scans all points for all lanes at once.
  template <class W>
  Vec3<W> furthest_of_all(const Vec3<W>& n) const {
    Vec3<W> best = widen<W>(points_->front());
    W furthest = n.dot(best);
    for (const Vec3<double>& point : *points_) {
      const Vec3<W> candidate = widen<W>(point);
      const W along = n.dot(candidate);
      const auto further = along > furthest;
      best = select<W>(further, candidate, best);
      furthest = select(further, along, furthest);
    }
    return best;
  }

  std::shared_ptr<const std::vector<Vec3<double>>> points_;
  std::shared_ptr<const DirectionTable> table_;  ///< null for few points: a scan is faster
  std::shared_ptr<const FacetMesh> facets_;      ///< null for flat hulls
  std::string source_;
};

extern template std::size_t PointCloud::furthest(const Vec3<double>&, double) const;
extern template std::size_t PointCloud::furthest(const Vec3<long double>&, long double) const;

}  // namespace minkray
