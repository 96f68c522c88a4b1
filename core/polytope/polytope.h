// SPDX-License-Identifier: MIT
// Finds where a line enters the convex hull of points: by walking over its triangles to the one the
// line passes through; if that is in doubt, or the hull has few facets, between all its planes.
// Each plane has a bound on the depth of its triangles' points below it, so that nothing is assumed
// about how planes were found (docs/forms.md, "Polytopes with an error bound").
#pragma once

#include <memory>

#include "core/geometry/point_cloud.h"
#include "core/polytope/polytope_tables.h"
#include "core/query/line.h"

namespace minkray::exact {

/// Immutable once made; all lengths are counted from the middle that was given.
class Polytope {
 public:
  /// Null if the points' hull is flat, or so thin that its planes' depths use it up, or has more
  /// points than planes are searched for; or if it is to be grown by a radius and is not convex,
  /// or its triangles are not high enough for rounding to decide which of its features are next to
  /// a line. Points are multiplied by `down` first.
  template <class T>
  static std::shared_ptr<const Polytope> of(const PointCloud<T>& points, const Vec3<double>& middle,
                                            double down, double rounded_by = 0);

  /// A triangle grown by a radius, which counts from the middle and has two sides. Null if the
  /// radius is 0 or the triangle not high enough.
  static std::shared_ptr<const Polytope> of(const std::array<Vec3<double>, 3>& corners,
                                            double rounded_by);

  /// The ball of this radius around the middle holds it.
  double radius() const { return radius_; }
  /// Bounds how far rounding moves the point where a line crosses a plane, across the line, or
  /// meets an adjacent feature of the grown polytope; to be added to the line's E.
  double rounding() const { return rounding_; }
  std::size_t planes() const { return tables_.plane_count(); }
  const PolytopeTables& tables() const { return tables_; }

 private:
  class Maker;

  /// Computes the ball around the vertices, and the values that follow from their extents.
  Polytope(const std::vector<Vec3<double>>& vertices, double rounded_by);

  PolytopeTables tables_;
  double radius_ = 0;
  double rounding_ = 0;
};

extern template std::shared_ptr<const Polytope> Polytope::of(const PointCloud<float>&,
                                                             const Vec3<double>&, double, double);
extern template std::shared_ptr<const Polytope> Polytope::of(const PointCloud<double>&,
                                                             const Vec3<double>&, double, double);

/// The lines meet the ball, and their E has the rounding added.
template <class W>
Entry<W> enter_tables(const PolytopeTables& polytope, const Line<W>& line, const Mask<W>& open);

template <class W>
Entry<W> enter_polytope(const Polytope& polytope, const Line<W>& line, const Mask<W>& open) {
  const W E = line.E + W(polytope.rounding());
  const W reach = W(polytope.radius()) + W(2) * E;
  const Mask<W> past_ball = open & (line.s.squaredNorm() > reach * reach);
  const Mask<W> near = open & !past_ball;
  if (!any(near)) {
    Entry<W> entry;
    entry.miss = past_ball;
    entry.normal = line.s;
    return entry;
  }
  Entry<W> entry = enter_tables<W>(polytope.tables(),
                                   {line.s, line.d, line.dd, line.inv, E, line.parallel}, near);
  if (any(past_ball)) {
    entry.miss |= past_ball;
    entry.normal = select<W>(past_ball, line.s, entry.normal);
  }
  return entry;
}

}  // namespace minkray::exact
