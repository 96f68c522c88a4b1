// SPDX-License-Identifier: MIT
// Finds where a line meets the hull of few points: clipped by the planes of its facets, which are
// found by trying every three of the points, in long double. Independent of Qhull and of supports.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "core/math/vec.h"

namespace minkray::testing {

class HalfSpaces {
 public:
  using Long = long double;

  /// The points must span space; a plane through three of them belongs to the hull if no point lies
  /// further beyond it than rounding explains.
  explicit HalfSpaces(std::span<const Vec3<double>> points) {
    Long size = 0;
    for (const Vec3<double>& p : points) size = std::max(size, Long(p.cwiseAbs().maxCoeff()));
    const Long slack = 64 * std::numeric_limits<Long>::epsilon() * size;
    const auto at = [&](std::size_t i) -> Vec3<Long> { return points[i].cast<Long>(); };
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = i + 1; j < points.size(); ++j)
        for (std::size_t k = j + 1; k < points.size(); ++k) {
          const Vec3<Long> across = (at(j) - at(i)).cross(at(k) - at(i));
          const Long length = across.norm();
          if (!(length > slack * size)) continue;
          add_if_outer(points, across / length, {i, j, k}, slack);
          add_if_outer(points, -across / length, {i, j, k}, slack);
        }
  }

  struct Plane {
    Vec3<Long> normal, point;
    std::array<std::size_t, 3> through;  ///< the points it was found by; point is the first
  };
  /// One for each three points of a facet: several, if it has more than three.
  const std::vector<Plane>& planes() const { return planes_; }
  std::size_t size() const { return planes_.size(); }

  /// The line o + t d lies in the hull, all planes moved out by `grown`, for lower <= t <= upper.
  struct Part {
    Long lower = -std::numeric_limits<Long>::infinity();
    Long upper = std::numeric_limits<Long>::infinity();
    Vec3<Long> normal = Vec3<Long>::Zero();  ///< of the plane entered by
    bool empty() const { return !(lower <= upper); }
  };
  Part clip(const Vec3<Long>& o, const Vec3<Long>& d, Long grown = 0) const {
    Part part;
    for (const Plane& plane : planes_) {
      const Long slope = plane.normal.dot(d);
      const Long room = plane.normal.dot(plane.point - o) + grown;
      if (slope == 0) {
        if (room < 0) part.lower = std::numeric_limits<Long>::infinity();
      } else if (slope < 0) {
        if (room / slope > part.lower) part.lower = room / slope, part.normal = plane.normal;
      } else {
        part.upper = std::min(part.upper, room / slope);
      }
    }
    return part;
  }

 private:
  void add_if_outer(std::span<const Vec3<double>> points, const Vec3<Long>& normal,
                    const std::array<std::size_t, 3>& through, Long slack) {
    const Vec3<Long> point = points[through[0]].cast<Long>();
    for (const Vec3<double>& p : points)
      if (normal.dot(p.cast<Long>() - point) > slack) return;
    planes_.push_back({normal, point, through});
  }

  std::vector<Plane> planes_;
};

}  // namespace minkray::testing
