// SPDX-License-Identifier: MIT
// Finds where a line enters the convex hull of points, by a walk over the hull's triangles to the
// one that the line passes through. If the walk is undecided or the hull has few facets, tests the
// planes of all facets instead. Each plane has a bound on the depth of its triangles' points below
// the plane. The error bound therefore holds for planes from any source (docs/forms.md, "Polytopes
// with an error bound").
#pragma once

#include <memory>

#include "core/geometry/point_cloud.h"
#include "core/polytope/polytope_tables.h"
#include "core/query/line.h"

namespace minkray::exact {

/// A hull prepared for entries of lines, optionally grown by a radius (rounded). Immutable.
/// Positions are relative to the given middle.
class Polytope {
 public:
  /// Prepares the hull of `points`, multiplied by `down` and grown by `rounded_by`. Returns null if
  /// there are no facets or too many points, or if the hull is flat or not thicker than the depths
  /// of its planes. If rounded_by > 0, also returns null if the hull is not convex, or if the
  /// heights of its triangles are so small that rounding confuses adjacent features.
  static std::shared_ptr<const Polytope> of(const PointCloud& points, const Vec3<double>& middle,
                                            double down, double rounded_by = 0);

  /// Prepares a triangle with two sides, grown by a radius; corners are relative to the middle.
  /// Returns null if the radius is 0 or the triangle's height is too small.
  static std::shared_ptr<const Polytope> of(const std::array<Vec3<double>, 3>& corners,
                                            double rounded_by);

  /// Radius of a ball around the middle that contains the polytope.
  double radius() const { return radius_; }
  /// Bound of the rounding error, across the line, of the point where a line crosses a plane or
  /// meets an adjacent feature of the grown polytope. Add this to the line's E.
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

/// Finds where lines enter the polytope with these tables, in the `open` lanes. The lines must meet
/// the polytope's ball, and their E must include its rounding().
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
