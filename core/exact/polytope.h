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
  /// It is null where the points' hull is flat, or so thin that its planes' depths use it up, or
  /// has more points than planes are looked for. Points are multiplied by `down` first.
  template <class T>
  static std::shared_ptr<const Polytope> of(const PointCloud<T>& points, const Vec3<double>& middle,
                                            double down);

  /// The ball of this radius around the middle holds all points.
  double radius() const { return radius_; }
  /// It bounds how far rounding moves where a line crosses a plane, across it, or meets what is
  /// next to it in the polytope grown by a radius: it is to be added to the line's E.
  double rounding(double rounded_by) const;
  std::size_t planes() const { return planes_.size(); }

  /// The line must meet the ball, and its E have the rounding added.
  Entry<double> enter(const Line<double>& line) const;

  /// Whether it is convex, and its triangles high, enough for rounding to tell which of its pieces
  /// are next to a line.
  bool can_be_rounded() const { return room_for_rounding_ > 0; }
  /// Enters the polytope grown by a radius, whose ball is larger.
  Entry<double> enter_rounded(double radius, const Line<double>& line) const;

 private:
  /// Corners counter-clockwise from outside. `beyond` is the triangle beyond the edge from corner k
  /// to k + 1, times four, plus the number of that edge there.
  struct Triangle {
    std::array<std::uint32_t, 3> corner, beyond;
    std::uint32_t plane;
  };
  /// Where a walk ended: in a triangle that the line passes through, clearly or not; or at an edge
  /// of one beyond which it passes the polytope by.
  struct WalkEnd {
    enum Where : unsigned char { lost, in_triangle, past_edge } where = lost;
    std::uint32_t triangle = 0, edge = 0;
    bool is_clear = false;
  };
  class Maker;
  class RoundedWalk;
  struct Projection;

  Polytope() = default;
  WalkEnd follow(const Line<double>& line) const;
  bool walk(const Line<double>& line, Entry<double>& entry) const;
  void scan(const Line<double>& line, Entry<double>& entry) const;
  std::uint32_t first_triangle(const Line<double>& line) const;
  bool settle_hit(std::size_t plane, const Line<double>& line, Entry<double>& entry) const;
  bool settle_miss(std::size_t entered, std::size_t left, const Line<double>& line,
                   Entry<double>& entry) const;

  std::vector<Vec3<double>> vertices_;
  std::vector<Triangle> triangles_;
  PlaneRows planes_;
  Vec3<double> inner_ = {0, 0, 0};  ///< a point well within
  double radius_ = 0;
  double rounding_ = 0;
  Vec3<double> by_extents_ = {1, 1, 1};  ///< one by the half extents
  CubeMap directions_{1};
  std::vector<std::uint32_t> facing_;  ///< a triangle for each cell of normals
  double room_for_rounding_ = 0;       ///< the least height of a triangle by the radius; or 0
  bool has_avx2_ = false;
};

extern template std::shared_ptr<const Polytope> Polytope::of(const PointCloud<float>&,
                                                             const Vec3<double>&, double);
extern template std::shared_ptr<const Polytope> Polytope::of(const PointCloud<double>&,
                                                             const Vec3<double>&, double);

/// Lines that meet the ball go lane by lane: side by side they soon walk over different triangles.
template <class W>
Entry<W> enter_polytope(const Polytope& polytope, double rounded_by, const Line<W>& line,
                        const Mask<W>& open) {
  Entry<W> entry;
  const W E = line.E + W(polytope.rounding(rounded_by));
  const W reach = W(polytope.radius() + rounded_by) + W(2) * E;
  entry.miss = open & (line.s.squaredNorm() > reach * reach);
  entry.normal = line.s;
  const Mask<W> near = open & !entry.miss;
  if (!any(near)) return entry;
  if constexpr (std::is_same_v<W, double>) {
    const Line<double> same{line.s, line.d, line.dd, line.inv, E, line.parallel};
    return rounded_by > 0 ? polytope.enter_rounded(rounded_by, same) : polytope.enter(same);
  } else {
    W hit(0), miss = select(entry.miss, W(1), W(0));
    for (int i = 0; i < LaneOf<W>::count; ++i) {
      if (!near.lane(i)) continue;
      const auto lane = [i](const Vec3<W>& v) -> Vec3<double> {
        return {v.x().lane(i), v.y().lane(i), v.z().lane(i)};
      };
      const Line<double> same{lane(line.s),     lane(line.d), line.dd.lane(i),
                              line.inv.lane(i), E.lane(i),    line.parallel.lane(i)};
      const Entry<double> one =
          rounded_by > 0 ? polytope.enter_rounded(rounded_by, same) : polytope.enter(same);
      hit.set_lane(i, one.hit ? 1 : 0);
      miss.set_lane(i, one.miss ? 1 : 0);
      entry.t.set_lane(i, one.t);
      entry.e.set_lane(i, one.e);
      for (int k = 0; k < 3; ++k) entry.normal[k].set_lane(i, one.normal[k]);
    }
    entry.hit = hit > W(0);
    entry.miss = miss > W(0);
    return entry;
  }
}

}  // namespace minkray::exact
