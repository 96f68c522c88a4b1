// SPDX-License-Identifier: MIT
// The points whose convex hull a shape is. Making one keeps just the extreme points.
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "core/shape/direction_table.h"

namespace minkray {

/// Immutable and shared: copies are cheap. Coplanar, collinear and single points are legal.
template <class T>
class PointCloud {
 public:
  PointCloud() = default;
  /// At least one point, all of them finite; `source` names the mesh file they came from, if any.
  explicit PointCloud(std::vector<Vec3<T>> points, std::string source = {});

  /// The extreme points, in the order in which they were given.
  const std::vector<Vec3<T>>& points() const { return *points_; }
  const std::string& source() const { return source_; }

  /// Rounded to U. What was found out about the points is shared rather than found out again: the
  /// support stays a maximum up to the rounding of the points.
  template <class U>
  PointCloud<U> cast() const {
    PointCloud<U> converted;
    auto points = std::make_shared<std::vector<Vec3<U>>>();
    points->reserve(points_->size());
    for (const Vec3<T>& p : *points_) points->push_back(p.template cast<U>());
    converted.points_ = std::move(points);
    converted.table_ = table_;
    converted.source_ = source_;
    return converted;
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    if constexpr (std::floating_point<W>) {
      const Vec3<T>* const points = points_->data();
      if (!table_)
        return points[furthest_of(
                          points_->size(), [](std::size_t i) { return i; }, n)]
            .template cast<W>();
      const std::span<const std::uint32_t> list = table_->candidates(n);
      return points[furthest_of(
                        list.size(), [&](std::size_t i) { return list[i]; }, n)]
          .template cast<W>();
    } else {
      return furthest_of_all(n);
    }
  }

  std::size_t memory_bytes() const {
    return points_->capacity() * sizeof(Vec3<T>) + (table_ ? table_->memory_bytes() : 0);
  }

 private:
  template <class U>
  friend class PointCloud;

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

  /// By index: keeping the point itself would copy three numbers wherever a maximum is beaten.
  template <std::floating_point W, class Index>
  std::size_t furthest_of(std::size_t size, Index&& index, const Vec3<W>& n) const {
    const Vec3<T>* const points = points_->data();
    std::size_t best = index(0);
    W furthest = n.dot(widen<W>(points[best]));
    for (std::size_t i = 1; i < size; ++i) {
      const W along = n.dot(widen<W>(points[index(i)]));
      best = along > furthest ? index(i) : best;
      furthest = along > furthest ? along : furthest;
    }
    return best;
  }

  std::shared_ptr<const std::vector<Vec3<T>>> points_;
  std::shared_ptr<const DirectionTable> table_;  ///< none for few points, which are scanned faster
  std::string source_;
};

extern template class PointCloud<float>;
extern template class PointCloud<double>;

}  // namespace minkray
