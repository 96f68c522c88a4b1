// SPDX-License-Identifier: MIT
// A mesh's first hit and its distance from a point, triangle by triangle in long double.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "core/math/affine.h"
#include "core/math/ray.h"
#include "tests/support/meshes.h"

namespace minkray::testing {

using LongVec = Vec3<long double>;

class MeshTruth {
 public:
  MeshTruth(const Surface& surface, const Affine<double>& pose) {
    for (const Corners& corners : surface.triangles) {
      triangles_.emplace_back();
      for (std::size_t k = 0; k < 3; ++k)
        triangles_.back()[k] =
            pose.cast<long double>()(surface.vertices[corners[k]].cast<long double>());
    }
  }

  struct Hit {
    long double t = std::numeric_limits<long double>::infinity();
    std::size_t triangle = 0;
    long double margin = 0;  ///< least barycentric coordinate
    bool found() const { return t < std::numeric_limits<long double>::infinity(); }
  };

  /// The first triangle by Cramer's rule (Moeller and Trumbore, 1997).
  Hit first_hit(const Ray<double>& ray) const {
    const LongVec o = ray.origin.cast<long double>(), d = ray.direction.cast<long double>();
    Hit first;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const auto& [a, b, c] = triangles_[i];
      const LongVec e = b - a, f = c - a, p = d.cross(f);
      const long double det = e.dot(p);
      if (det == 0) continue;
      const LongVec from = o - a, q = from.cross(e);
      const long double u = from.dot(p) / det, v = d.dot(q) / det, t = f.dot(q) / det;
      const long double margin = std::min({u, v, 1 - u - v});
      if (margin < 0 || t < 0 || t > static_cast<long double>(ray.t_max) || t >= first.t) continue;
      first = {t, i, margin};
    }
    return first;
  }

  LongVec normal(std::size_t triangle) const {
    const auto& [a, b, c] = triangles_[triangle];
    return LongVec(b - a).cross(LongVec(c - a)).normalized();
  }

  long double distance(const Vec3<double>& point) const {
    long double least = std::numeric_limits<long double>::infinity();
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      least = std::min(least, distance(triangles_[i], normal(i), point.cast<long double>()));
    return least;
  }

 private:
  using Triangle = std::array<LongVec, 3>;

  /// To the plane if the point's foot lies within, else to the nearest edge.
  static long double distance(const Triangle& triangle, const LongVec& normal, const LongVec& p) {
    bool is_within = true;
    long double least = std::numeric_limits<long double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const LongVec &from = triangle[k], edge = triangle[(k + 1) % 3] - from;
      is_within = is_within && normal.dot(edge.cross(LongVec(p - from))) >= 0;
      const long double share =
          std::clamp(edge.dot(LongVec(p - from)) / edge.squaredNorm(), 0.0L, 1.0L);
      least = std::min(least, LongVec(p - from - share * edge).norm());
    }
    return is_within ? std::abs(normal.dot(LongVec(p - triangle[0]))) : least;
  }

  std::vector<Triangle> triangles_;
};

}  // namespace minkray::testing
