// SPDX-License-Identifier: MIT
// The points whose convex hull a shape is. Making one keeps just the extreme points.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

/// Immutable and shared: copies are cheap. Coplanar, collinear and single points are legal.
template <class T>
class PointCloud {
 public:
  PointCloud() = default;
  /// At least one point, all of them finite; `source` names the mesh file they came from, if any.
  explicit PointCloud(std::vector<Vec3<T>> points, std::string source = {})
      : points_(std::make_shared<const std::vector<Vec3<T>>>(std::move(points))),
        source_(std::move(source)) {}

  const std::vector<Vec3<T>>& points() const { return *points_; }
  const std::string& source() const { return source_; }

  template <class U>
  PointCloud<U> cast() const {
    std::vector<Vec3<U>> converted;
    converted.reserve(points_->size());
    for (const Vec3<T>& p : *points_) converted.push_back(p.template cast<U>());
    return PointCloud<U>(std::move(converted), source_);
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
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

 private:
  std::shared_ptr<const std::vector<Vec3<T>>> points_;
  std::string source_;
};

}  // namespace minkray
