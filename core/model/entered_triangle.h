// SPDX-License-Identifier: MIT
// Finds where a line enters a hull with stored triangles, or such a hull grown by a radius: walks
// from triangle to triangle.
#pragma once

#include "core/geometry/facet_mesh.h"
#include "core/model/facet_plane.h"
#include "core/model/line_cast.h"

namespace minkray {

template <class W, class Core>
requires(declared_by<Core>.facets) struct Facets<W, Core> {
  using T = Lane<W>;
  static constexpr bool some = true;
  static bool known(const Core& hull) { return hull.points.facets() != nullptr; }

  /// Projected along the ray, the facets that face it form a triangulation. The walk starts at a
  /// facet that is likely to be near, and leaves each triangle through the edge that the line is
  /// furthest beyond (Devillers, Pion and Teillaud, "Walking in a Triangulation", 2002). If the
  /// next facet faces away, the edge is on the outline and the line misses.
  static EnteredFacet<W> entered(const Core& hull, const Vec3<T>& half_extents, const Vec3<W>& s,
                                 const Vec3<W>& from, const RayFrame<W>& frame) {
    using std::max;
    using std::min;
    const FacetMesh& mesh = *hull.points.facets();
    const Vec3<W> guess = normal_on_extents<W>(half_extents, s, Vec3<W>(-frame.z));
    // The rounding of corners relative to the ray; hulls may be far from the origin of their frame.
    const T R = half_extents.norm();
    const W rounding =
        W(T(2) * tolerance::epsilon<T>) * (W(R) + Vec3<W>(from - s).cwiseAbs().sum());

    EnteredFacet<W> facet;
    W at = start(mesh, guess, frame, 0);
    Mask<W> open = Mask<W>(true), stepped = Mask<W>(false), past_edge = Mask<W>(false);
    Mask<W> at_edge = Mask<W>(false);
    Vec3<W> outline = Vec3<W>::Zero();
    std::array<Vec3<W>, 3> corners = {Vec3<W>::Zero(), Vec3<W>::Zero(), Vec3<W>::Zero()};
    for (int step = 0; step < max_steps; ++step) {
      const auto row = mesh.template numbers<Row::corners, Row::normals - Row::corners>(at);
      const std::array<Vec3<W>, 3> p = corners_of(row, from, frame);
      const W a = cross_2d(p[0], p[1]), b = cross_2d(p[1], p[2]), c = cross_2d(p[2], p[0]);
      const Mask<W> away = open & !(a + b + c > W(0));
      const Mask<W> lost = step < restarts ? Mask<W>(away & !stepped) : Mask<W>(false);
      past_edge |= away & stepped;
      open &= !away;
      for (std::size_t k = 0; k < 3; ++k) corners[k] = select<W>(open, p[k], corners[k]);
      facet.known |= open;
      const Mask<W> within = open & (a >= W(0)) & (b >= W(0)) & (c >= W(0));
      facet.enters |= within;
      at_edge |= within & (min(a, min(b, c)) <= rounding * W(T(8) * R));
      open &= !within;
      if (!any(open | lost)) break;

      const Mask<W> by_b = b < a, by_c = (c < a) & (c < b);
      const Vec3<W> begin = select<W>(by_c, p[2], select<W>(by_b, p[1], p[0]));
      const Vec3<W> end = select<W>(by_c, p[0], select<W>(by_b, p[2], p[1]));
      outline = select<W>(open, Vec3<W>(end.y() - begin.y(), begin.x() - end.x(), W(0)), outline);
      at = select(open, beyond(row, by_b, by_c), at);
      stepped |= open;
      if (any(lost)) at = select(lost, start(mesh, guess, frame, step + 1), at);
      open |= lost;
    }

    if (any(at_edge)) settle(mesh, from, frame, at_edge, rounding, at, corners);
    const auto plane = mesh.template numbers<Row::normals, Row::size - Row::normals>(at);
    facet.in_shape = Vec3<W>(plane[0], plane[1], plane[2]);
    facet.normal = frame.into(facet.in_shape);
    // For a facet seen edge-on, only a normal computed from the corners themselves is exact enough.
    const Mask<W> steep = facet.enters & !(facet.normal.z() > W(least_facing));
    facet.supported = facet.enters & (plane[Row::supported - Row::normals] > W(0)) & !steep;
    const auto replace_normal = [&](const Mask<W>& lanes, const Vec3<W>& normal) {
      facet.normal = select<W>(lanes, normal, facet.normal);
      facet.in_shape = select<W>(lanes, frame.out_of(normal), facet.in_shape);
    };
    if (any(steep)) replace_normal(steep, upper_normal(corners[0], corners[1], corners[2]));
    if (any(past_edge)) replace_normal(past_edge, unit<W>(outline));
    const Mask<W> has_normal = facet.normal.squaredNorm() > W(0);
    facet.known &= has_normal;
    facet.enters &= has_normal;
    // Limits the height to the range of the corners' heights, since the plane may be nearly
    // parallel to the ray.
    const auto& [a, b, c] = corners;
    const W z = select(facet.normal.z() > W(0), facet.normal.z(), W(1));
    facet.height = min(max(W(a.dot(facet.normal) / z), min(a.z(), min(b.z(), c.z()))),
                       max(a.z(), max(b.z(), c.z())));
    facet.corner = a;
    facet.neighbours = {b, c, a};
    facet.there = {facet.enters, facet.enters, facet.enters};
    return facet;
  }

  /// Finds the point where the line meets a facet's plane, moved out by the radius. If the point's
  /// projection to the facet is beyond an edge, the facet beyond this edge is next. If two facets
  /// lead to each other, the result is the edge between them.
  static EnteredFacet<W> around(const Core& hull, T radius, const Vec3<T>& half_extents,
                                const Vec3<W>& s, const Vec3<W>& from, const RayFrame<W>& frame) {
    const FacetMesh& mesh = *hull.points.facets();
    const Vec3<W> guess = normal_on_extents<W>(half_extents, s, Vec3<W>(-frame.z));
    // Facets are stored as supported if they are thick relative to the hull. Here, facets must also
    // be thick relative to the radius, since otherwise rounding decides which facet is next.
    const T R = half_extents.maxCoeff();
    const bool tells = T(4) * (R - radius) >= R;

    EnteredFacet<W> facet;
    facet.normal = Vec3<W>(W(0), W(0), W(1));
    W at = start(mesh, guess, frame, 0), last = W(-1);
    Mask<W> open = Mask<W>(true), stepped = Mask<W>(false);
    // The edge that the last step crossed, the corner opposite to it, and the projected point.
    Vec3<W> begin = Vec3<W>::Zero(), end = begin, behind = begin, foot = begin;
    const auto answer = [&](const Mask<W>& lanes, const Vec3<W>& a, const Vec3<W>& b,
                            const Vec3<W>& c, const Vec3<W>& d, const Mask<W>& has_d) {
      facet.known |= lanes;
      facet.corner = select<W>(lanes, a, facet.corner);
      facet.neighbours[0] = select<W>(lanes, b, facet.neighbours[0]);
      facet.neighbours[1] = select<W>(lanes, c, facet.neighbours[1]);
      facet.neighbours[2] = select<W>(lanes, d, facet.neighbours[2]);
      facet.there[0] |= lanes;
      facet.there[1] |= lanes;
      facet.there[2] |= lanes & has_d;
    };
    // Passes the nearer corner of the edge first.
    const auto answer_edge = [&](const Mask<W>& lanes, const Vec3<W>& a, const Vec3<W>& b,
                                 const Vec3<W>& c, const Vec3<W>& d, const Mask<W>& has_d) {
      const Mask<W> swap = (b - foot).squaredNorm() < (a - foot).squaredNorm();
      answer(lanes, select<W>(swap, b, a), select<W>(swap, a, b), c, d, has_d);
    };
    for (int step = 0; step < max_steps; ++step) {
      const auto row = mesh.template numbers<Row::corners, Row::size>(at);
      const std::array<Vec3<W>, 3> p = corners_of(row, from, frame);
      const Vec3<W> m = frame.into(normal_of(row));
      const Mask<W> away = open & !(m.z() > W(least_facing));
      const Mask<W> lost = step < restarts ? Mask<W>(away & !stepped) : Mask<W>(false);
      if (any(away)) {
        answer_edge(away & stepped, begin, end, behind, behind, Mask<W>(false));
        open &= !away;
        if (!any(open | lost)) break;
      }
      const W height = (p[0].dot(m) + W(radius)) / select(m.z() > W(least_facing), m.z(), W(1));
      foot = select<W>(open, Vec3<W>(Vec3<W>(W(0), W(0), height) - m * W(radius)), foot);
      const auto within_edge = [&](const Vec3<W>& a, const Vec3<W>& b) {
        return (b - a).cross(foot - a).dot(m);
      };
      const W a = within_edge(p[0], p[1]), b = within_edge(p[1], p[2]), c = within_edge(p[2], p[0]);
      const Mask<W> within = open & (a >= W(0)) & (b >= W(0)) & (c >= W(0));
      if (any(within)) {
        answer(within, p[0], p[1], p[2], p[2], Mask<W>(false));
        const Mask<W> enters = within & (row[Row::supported] > W(0)) & Mask<W>(tells);
        facet.enters |= enters;
        facet.supported |= enters;
        facet.normal = select<W>(enters, m, facet.normal);
        for (int k = 0; k < 3; ++k)
          facet.in_shape[k] =
              select(enters, row[Row::normals + static_cast<std::size_t>(k)], facet.in_shape[k]);
        facet.height = select(enters, height, facet.height);
        open &= !within;
        if (!any(open | lost)) break;
      }

      const Mask<W> by_b = b < a, by_c = (c < a) & (c < b);
      const W to = beyond(row, by_b, by_c);
      const Vec3<W> from_corner = select<W>(by_c, p[2], select<W>(by_b, p[1], p[0]));
      const Vec3<W> to_corner = select<W>(by_c, p[0], select<W>(by_b, p[2], p[1]));
      const Vec3<W> opposite = select<W>(by_c, p[1], select<W>(by_b, p[0], p[2]));
      const Mask<W> returns = open & (to == last);
      if (any(returns)) {
        answer_edge(returns, from_corner, to_corner, opposite, behind, Mask<W>(true));
        open &= !returns;
        if (!any(open | lost)) break;
      }
      begin = select<W>(open, from_corner, begin);
      end = select<W>(open, to_corner, end);
      behind = select<W>(open, opposite, behind);
      last = select(open, at, last);
      at = select(open, to, at);
      stepped |= open;
      if (any(lost)) at = select(lost, start(mesh, guess, frame, step + 1), at);
      open |= lost;
    }
    return facet;
  }

 private:
  using Row = typename FacetMesh::Facet;

  /// If the line passes an edge within rounding, the line also enters the facet beyond the edge.
  /// The crossing with that facet has less rounding if the facet faces the ray more. A facet seen
  /// nearly edge-on may, due to rounding, be crossed long before the edge.
  static void settle(const FacetMesh& mesh, const Vec3<W>& from, const RayFrame<W>& frame,
                     const Mask<W>& at_edge, const W& rounding, W& at,
                     std::array<Vec3<W>, 3>& corners) {
    using std::abs;
    constexpr int around_a_corner = 4;
    for (int hop = 0; hop < around_a_corner; ++hop) {
      const auto here = mesh.template numbers<Row::corners, Row::size>(at);
      W facing = frame.z.dot(normal_of(here)), next = at;
      for (std::size_t k = 0; k < 3; ++k) {
        const W& beyond_edge = here[Row::neighbours + k];
        const auto row = mesh.template numbers<Row::corners, Row::size>(beyond_edge);
        const W its = frame.z.dot(normal_of(row));
        const Vec3<W>&a = corners[k], &b = corners[(k + 1) % 3];
        const W length = abs(b.x() - a.x()) + abs(b.y() - a.y());
        // Requires a line next to the edge, not beyond its ends: on slivers, all edges are nearly
        // on one line.
        const W along = a.x() * b.x() + a.y() * b.y();
        const Mask<W> near = (cross_2d(a, b) <= rounding * length) & (along <= rounding * length);
        const Mask<W> better = at_edge & near & (its > facing);
        next = select(better, beyond_edge, next);
        facing = select(better, its, facing);
      }
      const Mask<W> moves = next != at;
      if (!any(moves)) return;
      at = next;
      const auto row = mesh.template numbers<Row::corners, Row::size>(at);
      const std::array<Vec3<W>, 3> p = corners_of(row, from, frame);
      for (std::size_t k = 0; k < 3; ++k) corners[k] = select<W>(moves, p[k], corners[k]);
    }
  }

  template <class Numbers>
  static Vec3<W> normal_of(const Numbers& row) {
    return {row[Row::normals], row[Row::normals + 1], row[Row::normals + 2]};
  }

  /// Corners in the ray's frame, relative to a point.
  template <class Numbers>
  static std::array<Vec3<W>, 3> corners_of(const Numbers& row, const Vec3<W>& from,
                                           const RayFrame<W>& frame) {
    const auto corner = [&](std::size_t k) {
      const std::size_t first = Row::corners + 3 * k;
      return frame.into(Vec3<W>(row[first], row[first + 1], row[first + 2]) - from);
    };
    return {corner(0), corner(1), corner(2)};
  }

  /// Returns the neighbour beyond the third edge, the second edge, or else the first.
  template <class Numbers>
  static W beyond(const Numbers& row, const Mask<W>& second, const Mask<W>& third) {
    return select(third, row[Row::neighbours + 2],
                  select(second, row[Row::neighbours + 1], row[Row::neighbours]));
  }

  /// The guessed direction at the start of a walk is tilted towards the ray. The first tilt is
  /// small: enough for most guesses perpendicular to the ray. If the facet found faces away, larger
  /// tilts follow, whose facets are further away, but more likely to face the ray.
  static constexpr std::array<T, 3> tilts = {T(1) / T(32), T(1) / T(2), T(4)};
  static constexpr int restarts = static_cast<int>(tilts.size()) - 1;
  static W start(const FacetMesh& mesh, const Vec3<W>& guess, const RayFrame<W>& frame,
                 int attempt) {
    return mesh.facing(Vec3<W>(guess + frame.z * W(tilts[static_cast<std::size_t>(attempt)])));
  }

  /// Sine below which a facet counts as seen edge-on. For rounded hulls, such a facet counts as
  /// facing away: the line crosses the facet's moved plane a thousand radii from the facet.
  static constexpr T least_facing = T(1) / T(1024);
  /// Limit of steps. Without rounding, walks in regular triangulations always end, and are short
  /// from a near start. If a walk is longer, the cast continues without known facets.
  static constexpr int max_steps = 64;
};

}  // namespace minkray
