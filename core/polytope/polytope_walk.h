// SPDX-License-Identifier: MIT
// Walk of a line over a polytope's triangles (Devillers, Pion and Teillaud, "Walking in a
// Triangulation", 2002). One line and packets with one line per lane share this code; lanes
// continue until the last lane has arrived.
#pragma once

#include "core/polytope/polytope_planes.h"
#include "core/polytope/polytope_view.h"
#include "core/query/line.h"
#include "core/query/tolerances.h"

namespace minkray::exact {

/// End of a walk. `in_triangle`: the walk ended in a triangle that the line passes through; if
/// `is_clear` is set, the line is further from the triangle's edges than rounding. `past_edge`: the
/// walk ended at an edge of the outline, and the line misses. If neither is set, the walk failed.
template <class W>
struct WalkEnd {
  Mask<W> in_triangle = Mask<W>(false), is_clear = Mask<W>(false), past_edge = Mask<W>(false);
  W edge =
      W(0);  ///< a half-edge of the triangle; for a miss, the half-edge that the line is beyond
  W beyond = W(0);  ///< a half-edge of the triangle beyond `edge`
};

/// True if all edges, projected along the line, are further from the line than the error.
template <class W>
Mask<W> is_clear(const std::array<Seen<W>, 3>& p, const std::array<W, 3>& side, const W& E) {
  using std::abs;
  const W margin = W(tolerance::polytope_beside) * E;
  const auto size = [&](std::size_t k) { return abs(p[k].x) + abs(p[k].y); };
  const W a = size(0), b = size(1), c = size(2);
  return (side[0] > margin * (a + b)) & (side[1] > margin * (b + c)) & (side[2] > margin * (c + a));
}

/// Returns a half-edge of a triangle whose normal is near that of the ellipsoid with the same
/// extents, at the point where the line enters the ellipsoid.
template <class W>
W first_edge(const PolytopeTables& of, const Line<W>& line) {
  using std::max;
  using std::sqrt;
  // Squared depth to which a line that misses the ellipsoid is assumed to enter it.
  constexpr double least_depth = 1.0 / 64;
  const Vec3<W> by_extents = widen<W>(of.by_extents);
  const Vec3<W> d = line.d.cwiseProduct(by_extents), s = line.s.cwiseProduct(by_extents);
  const W inv = W(1) / d.squaredNorm();
  const Vec3<W> x = s - d * (s.dot(d) * inv);
  const W half = sqrt(max(W(1) - x.squaredNorm(), W(least_depth)) * inv);
  const Vec3<W> normal = (x - d * half).cwiseProduct(by_extents);
  return lookup(of.directions.cell_of(normal),
                [&](std::size_t cell) { return static_cast<double>(of.facing[cell]); });
}

/// Returns a half-edge of a triangle that faces the line.
template <class W>
W facing_edge(const PolytopeTables& of, const Line<W>& line) {
  return lookup(of.directions.cell_of(Vec3<W>(-line.d)),
                [&](std::size_t cell) { return static_cast<double>(of.facing[cell]); });
}

/// Limit of steps. Walks from a near start are short; longer walks have failed due to rounding.
inline constexpr int most_steps = 64;

/// Projected along the line, the triangles that face the line's origin form a triangulation. The
/// walk leaves each triangle through the edge that the line is furthest beyond. If the next
/// triangle faces away, the line misses.
template <class W>
WalkEnd<W> follow(const PolytopeTables& of, const Line<W>& line, Mask<W> open) {
  using std::abs;
  const View<W> view(line);
  std::array<Seen<W>, 3> p;
  // The triangle's half-edges; for each, twice the area of the triangle that the half-edge and the
  // projected line form.
  std::array<W, 3> edge, side;
  const auto begin_at = [&](const W& first) {
    for (std::size_t k = 0; k < 3; ++k) {
      edge[k] = first + W(static_cast<double>(k));
      const W vertex =
          lookup(edge[k], [&](std::size_t e) { return static_cast<double>(of.origin[e]); });
      const std::array<W, 4> place = gather_row<4>(vertex, of.vertices.data(), of.vertex_row);
      p[k] = view(place[0], place[1], place[2]);
    }
    for (std::size_t k = 0; k < 3; ++k) side[k] = cross(p[k], p[(k + 1) % 3]);
    return side[0] + side[1] + side[2] > W(0);
  };
  const W first = first_edge(of, line);
  const Mask<W> faces = begin_at(first);
  if (any(open & !faces)) open &= begin_at(select(faces, first, facing_edge(of, line)));
  // Lanes that have arrived keep stepping without effect.
  WalkEnd<W> end;
  for (int step = 0; step < most_steps && any(open); ++step) {
    const Mask<W> second = side[1] < side[0];
    const W lesser = select(second, side[1], side[0]);
    const Mask<W> third = side[2] < lesser;
    const W least = select(third, side[2], lesser);
    const auto of_least = [&](const W& a, const W& b, const W& c) {
      return select(third, c, select(second, b, a));
    };
    const Mask<W> within = open & !(least < W(0));
    if (any(within)) {
      end.in_triangle |= within;
      end.is_clear |= within & is_clear(p, side, line.E);
      end.edge = select(within, edge[1], end.edge);
      open &= !within;
      if (!any(open)) break;
    }
    const Seen<W> from{of_least(p[0].x, p[1].x, p[2].x), of_least(p[0].y, p[1].y, p[2].y)};
    const Seen<W> to{of_least(p[1].x, p[2].x, p[0].x), of_least(p[1].y, p[2].y, p[0].y)};
    const W crossed = of_least(edge[0], edge[1], edge[2]);
    const std::array<W, 4> row = gather_row<4>(crossed, of.walk.data(), of.walk_row);
    const W after = abs(row[3]);
    const Seen<W> last = view(row[0], row[1], row[2]);
    const W right = cross(from, last), left = cross(last, to);
    const Mask<W> past = open & !(-least + right + left > W(0));
    if (any(past)) {
      end.past_edge |= past;
      end.edge = select(past, crossed, end.edge);
      end.beyond = select(past, after, end.beyond);
      open &= !past;
    }
    p = {to, from, last};
    side = {-least, right, left};
    // Excludes the edge that was just crossed.
    edge = {after, after, after + select(row[3] < W(0), W(-2), W(1))};
  }
  return end;
}

/// A single line uses the same operations, but integers for half-edges, and selects by index
/// instead of branches that may be mispredicted.
template <>
inline WalkEnd<double> follow(const PolytopeTables& of, const Line<double>& line, bool /*open*/) {
  const View<double> view(line);
  std::array<Seen<double>, 3> p;
  std::array<double, 3> side;
  auto edge = static_cast<std::size_t>(first_edge(of, line));
  const auto faces = [&] {
    for (std::size_t k = 0; k < 3; ++k) {
      const double* const place = &of.vertices[of.origin[edge + k] * of.vertex_row];
      p[k] = view(place[0], place[1], place[2]);
    }
    for (std::size_t k = 0; k < 3; ++k) side[k] = cross(p[k], p[(k + 1) % 3]);
    return side[0] + side[1] + side[2] > 0;
  };
  WalkEnd<double> end;
  if (!faces()) {
    edge = static_cast<std::size_t>(facing_edge(of, line));
    if (!faces()) return end;
  }
  std::array<std::size_t, 3> edges = {edge, edge + 1, edge + 2};
  for (int step = 0; step < most_steps; ++step) {
    const std::size_t k = side[1] < side[0]   ? (side[2] < side[1] ? 2 : 1)
                          : side[2] < side[0] ? 2
                                              : 0;
    if (!(side[k] < 0)) {
      end.in_triangle = true;
      end.is_clear = is_clear(p, side, line.E);
      end.edge = static_cast<double>(edges[1]);
      return end;
    }
    const std::size_t crossed = edges[k];
    const double* const row = &of.walk[crossed * of.walk_row];
    const std::int32_t link = of.links[crossed];
    const auto after = static_cast<std::size_t>(std::abs(link));
    const Seen<double> from = p[k], to = p[(k + 1) % 3], last = view(row[0], row[1], row[2]);
    p = {to, from, last};
    side = {-side[k], cross(from, last), cross(last, to)};
    if (!(side[0] + side[1] + side[2] > 0)) {
      end.past_edge = true;
      end.edge = static_cast<double>(crossed);
      end.beyond = static_cast<double>(after);
      return end;
    }
    edges = {after, after, link < 0 ? after - 2 : after + 1};
  }
  return end;
}

/// Finds where lines that meet the ball enter the polytope (without a radius).
template <class W>
Entry<W> enter_planes(const PolytopeTables& of, const Line<W>& line, const Mask<W>& open) {
  using std::max;
  // Number of planes up to which all are tested without a walk.
  constexpr std::size_t most_scanned = 8;
  Entry<W> entry;
  Mask<W> unsure = open;
  if (of.plane_count() > most_scanned) {
    const WalkEnd<W> end = follow(of, line, open);
    const Mask<W> through = end.in_triangle & end.is_clear;
    const W plane = plane_of(of, end.edge);
    // If the line is nearly in a triangle's plane, rounding decides whether it enters between the
    // triangle's edges. Such lines are tested against all planes.
    if (any(through))
      settle_hit(of, plane, line, through, tolerance::uncertain_slope<Lane<W>>, entry);
    if (any(end.past_edge))
      settle_miss(of, plane, plane_of(of, end.beyond), line, end.past_edge, entry);
    unsure &= !(entry.hit | entry.miss);
  }
  if (!any(unsure)) return entry;
  const PlanesPassed<W> passed = pass_planes(of, line);
  const Mask<W> through = unsure & (passed.in_hi <= passed.out_lo), past = unsure & !through;
  if (any(through)) {
    settle_hit(of, passed.entered, line, through, 0, entry);
    entry.e = select(through, max(entry.e, W(passed.in_hi - entry.t)), entry.e);
  }
  if (any(past)) settle_miss(of, passed.entered, passed.left, line, past, entry);
  return entry;
}

}  // namespace minkray::exact
