// SPDX-License-Identifier: MIT
// Where a line enters the convex hull of points: by walking over its triangles to the one the line
// passes through, or where that is in doubt, or the hull has few facets, between all its planes.
//
// Each plane has a bound of how far the points of its triangles lie below it, so that nothing is
// asked of how planes were found. docs/theory.md ("Polytopes with an error bound") has the proof.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/exact/plane_rows.h"
#include "core/geometry/cube_map.h"
#include "core/geometry/point_cloud.h"

namespace minkray::exact {

/// Immutable once made; all lengths are counted from the middle that was given.
class Polytope {
 public:
  /// Null where the points' hull is flat, or so thin that its planes' depths use it up, or has more
  /// points than planes are looked for. Points are multiplied by `down` first.
  template <class T>
  static std::shared_ptr<const Polytope> of(const PointCloud<T>& points, const Vec3<double>& middle,
                                            double down);

  /// Of a ball around the middle that holds all points.
  double radius() const { return radius_; }
  std::size_t planes() const { return planes_.size(); }

  Entry<double> enter(const Line<double>& line) const;

 private:
  /// Corners counter-clockwise from outside. `beyond` is the triangle beyond the edge from corner k
  /// to k + 1, times four, plus the number of that edge there.
  struct Triangle {
    std::array<std::uint32_t, 3> corner, beyond;
    std::uint32_t plane;
  };
  class Maker;
  struct Projection;

  Polytope() = default;
  bool walk(const Line<double>& line, Entry<double>& entry) const;
  void scan(const Line<double>& line, Entry<double>& entry) const;
  std::size_t first_triangle(const Line<double>& line) const;
  bool settle_hit(std::size_t plane, const Line<double>& line, Entry<double>& entry) const;
  bool settle_miss(std::size_t entered, std::size_t left, const Line<double>& line,
                   Entry<double>& entry) const;

  std::vector<Vec3<double>> vertices_;
  std::vector<Triangle> triangles_;
  PlaneRows planes_;
  double radius_ = 0;
  double rounding_ = 0;                  ///< of where a line crosses a plane, across it
  Vec3<double> by_extents_ = {1, 1, 1};  ///< one by the half extents
  CubeMap directions_{1};
  std::vector<std::uint32_t> facing_;  ///< a triangle for each cell of normals
  bool has_avx2_ = false;
};

extern template std::shared_ptr<const Polytope> Polytope::of(const PointCloud<float>&,
                                                             const Vec3<double>&, double);
extern template std::shared_ptr<const Polytope> Polytope::of(const PointCloud<double>&,
                                                             const Vec3<double>&, double);

/// Lane by lane: lines side by side soon walk over different triangles.
template <class W>
Entry<W> enter_polytope(const Polytope& polytope, const Line<W>& line, const Mask<W>& open) {
  Entry<W> entry;
  if constexpr (std::is_same_v<W, double>) {
    if (open) entry = polytope.enter(line);
  } else {
    W hit(0), miss(0);
    for (int i = 0; i < LaneOf<W>::count; ++i) {
      if (!open.lane(i)) continue;
      const auto lane = [i](const Vec3<W>& v) -> Vec3<double> {
        return {v.x().lane(i), v.y().lane(i), v.z().lane(i)};
      };
      const Entry<double> one =
          polytope.enter({lane(line.s), lane(line.d), line.dd.lane(i), line.inv.lane(i),
                          line.E.lane(i), line.parallel.lane(i)});
      hit.set_lane(i, one.hit ? 1 : 0);
      miss.set_lane(i, one.miss ? 1 : 0);
      entry.t.set_lane(i, one.t);
      entry.e.set_lane(i, one.e);
      for (int k = 0; k < 3; ++k) entry.normal[k].set_lane(i, one.normal[k]);
    }
    entry.hit = hit > W(0);
    entry.miss = miss > W(0);
  }
  return entry;
}

}  // namespace minkray::exact
