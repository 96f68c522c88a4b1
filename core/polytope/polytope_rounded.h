// SPDX-License-Identifier: MIT
// Finds where a line enters a polytope that is grown by a radius: at a face moved outwards, the
// cylinder around an edge or the ball around a vertex. The line's contact with such a feature is
// the entry if no neighbouring feature rises above the contact; the feature then "supports". Walks
// from feature to feature (Lin and Canny, "A Fast Algorithm for Incremental Distance Calculation",
// 1991) to the one that supports. One line and packets share this code.
#pragma once

#include "core/polytope/polytope_walk.h"

namespace minkray::exact {

/// Tests all features for the one that supports. For lines whose walk failed.
Entry<double> enter_any_feature(const PolytopeTables& of, const Line<double>& line);

/// Feature of the surface that a half-edge represents: its triangle, its edge, or its origin.
namespace feature {
inline constexpr double none = 0, face = 1, edge = 2, vertex = 3;
}

template <class W>
class RoundedWalk {
 public:
  RoundedWalk(const PolytopeTables& polytope, const Line<W>& line)
      : of_(polytope), r_(polytope.rounded_by), line_(line) {}

  /// Walks from a triangle or an edge, feature by feature, to the one that supports. Lanes that
  /// find none are set in `lost`.
  Entry<W> from(const WalkEnd<W>& start, Mask<W>& lost) {
    constexpr int most_features = 24;
    feature_ = select(start.in_triangle, W(feature::face),
                      select(start.past_edge, W(feature::edge), W(feature::none)));
    at_ = start.edge;
    lost &= feature_ == W(feature::none);
    for (int i = 0; i < most_features; ++i)
      if (!look()) return entry_;
    lost |= feature_ != W(feature::none);
    return entry_;
  }

  /// Tests one feature only; returns false if the test leads to another feature.
  bool settles_at(double which, double edge) requires(std::is_same_v<W, double>) {
    entry_ = {};
    feature_ = which;
    at_ = edge;
    return !look() && (entry_.hit || entry_.miss);
  }

  const Entry<W>& entry() const { return entry_; }

 private:
  /// Point where the line enters a feature's cylinder or ball, or is closest to it.
  struct Contact {
    Mask<W> meets, is_clear;
    W t, e;
    Vec3<W> out;  ///< from the axis or centre to the contact
  };
  using Numbers = std::array<W, 12>;

  /// Tests each lane's feature; returns false if no test leads to another feature.
  bool look() {
    const Mask<W> at_faces = feature_ == W(feature::face);
    if (any(at_faces)) look_at_face(at_faces);
    const Mask<W> at_edges = feature_ == W(feature::edge);
    if (any(at_edges)) look_at_edge(at_edges);
    const Mask<W> at_vertices = feature_ == W(feature::vertex);
    if (any(at_vertices)) look_at_vertex(at_vertices);
    return any(feature_ != W(feature::none));
  }

  void go_to(const Mask<W>& which, double kind, const W& edge) {
    feature_ = select(which, W(kind), feature_);
    at_ = select(which, edge, at_);
  }

  template <std::size_t count>
  std::array<W, count> numbers(const W& edge, std::size_t from = 0) const {
    return gather_row<count>(edge, of_.features.data() + from, of_.feature_row);
  }
  static Vec3<W> vector(const auto& numbers, std::size_t from) {
    return {numbers[from], numbers[from + 1], numbers[from + 2]};
  }
  static Vec3<W> origin(const auto& of) { return vector(of, 0); }
  static W next(const auto& of) { return of[3]; }
  static Vec3<W> inwards(const auto& of) { return vector(of, 4); }
  static W twin(const auto& of) { return of[7]; }
  static Vec3<W> along(const Numbers& of) { return vector(of, 8); }
  static W length(const Numbers& of) { return of[11]; }

  /// Continues at a half-edge's triangle. If that triangle faces away, continues at the nearer of
  /// its two other edges.
  void go_over(const Mask<W>& which, const W& edge) {
    const PlaneRow<W> plane(of_, plane_of(of_, edge));
    const Mask<W> faces = plane.normal.dot(line_.d) < W(-least_component<W>);
    go_to(which & faces, feature::face, edge);
    const Mask<W> away = which & !faces;
    if (!any(away)) return;
    const W second = next(numbers<4>(edge)), third = next(numbers<4>(second));
    // Squared distance of an edge from the line.
    const auto distance = [&](const W& of) {
      const Numbers at = numbers<12>(of);
      const Vec3<W> across = along(at).cross(line_.d);
      const W product = across.dot(line_.s - origin(at));
      return product * product / across.squaredNorm();
    };
    go_to(away, feature::edge, select(distance(second) < distance(third), second, third));
  }

  /// The line has the points from + t way; both vectors are perpendicular to the axis. `across` is
  /// the squared length of `way`.
  Contact contact(const Vec3<W>& from, const Vec3<W>& way, const W& across) const {
    using std::abs;
    using std::max;
    using std::sqrt;
    Contact found;
    const W inv = W(1) / across, k = -from.dot(way) * inv;
    const Vec3<W> x = from + way * k;
    const W h2 = W(r_ * r_) - x.squaredNorm(), margin = W(4 * r_) * line_.E;
    found.is_clear = abs(h2) > margin;
    found.meets = h2 > W(0);
    const W half = sqrt(max(h2, W(0)) * inv);
    found.t = k - half;
    found.out = x - way * half;
    found.e = select(found.meets, W(2 * r_) * line_.E * inv / half, W(0));
    return found;
  }

  /// Sets a hit or miss. Undecided if another feature begins so near that its formula might apply,
  /// and the two formulas differ by more than E (docs/forms.md, section 13). Also undecided if the
  /// normal leans over the next feature, since for a small radius the normal has a large error.
  void settle(const Mask<W>& which, const Contact& found, const W& nearest_end) {
    feature_ = select(which, W(feature::none), feature_);
    const W width = found.e * found.e * line_.dd;
    const Mask<W> is_vague =
        found.meets & (width > W(r_) * line_.E) & (nearest_end * nearest_end < width);
    const Mask<W> leans = found.meets & (line_.E > W(tolerance::rounded_line_error * r_)) &
                          (nearest_end < W(4) * line_.E);
    const Mask<W> settled = which & !is_vague & !leans;
    entry_.hit |= settled & found.meets;
    entry_.miss |= settled & !found.meets;
    entry_.t = select(settled, found.t, entry_.t);
    entry_.e = select(settled, found.e, entry_.e);
    const W scale = select(found.meets, W(1 / r_), W(1));
    entry_.normal = select<W>(settled, Vec3<W>(found.out * scale), entry_.normal);
  }

  void look_at_face(Mask<W> which) {
    const PlaneRow<W> plane(of_, plane_of(of_, at_));
    const Vec3<W>& n = plane.normal;
    const W slope = n.dot(line_.d);
    const Mask<W> faces = slope < W(-least_component<W>);
    go_to(which & !faces, feature::none, at_);
    which &= faces;
    const W inv = W(-1) / slope;
    const W t = -(plane.offset + W(r_) - n.dot(line_.s)) * inv;
    const Vec3<W> foot = line_.s + line_.d * t - n * W(r_);
    W nearest(std::numeric_limits<double>::infinity()), beyond = at_, edge = at_;
    for (int k = 0; k < 3; ++k) {
      const std::array<W, 8> side = numbers<8>(edge);
      const W within = inwards(side).dot(foot - origin(side));
      const Mask<W> nearer = within < nearest;
      nearest = select(nearer, within, nearest);
      beyond = select(nearer, edge, beyond);
      edge = next(side);
    }
    const Mask<W> outside = which & (nearest < W(0));
    go_to(outside, feature::edge, beyond);
    which &= !outside;
    const W e = (line_.E + plane.depth) * inv;
    settle(which, {Mask<W>(true), Mask<W>(true), t, e, Vec3<W>(n * W(r_))}, nearest);
    entry_.normal = select<W>(which, n, entry_.normal);
  }

  void look_at_edge(Mask<W> which) {
    using std::max;
    using std::min;
    const Numbers edge = numbers<12>(at_);
    const Vec3<W> u = along(edge), a = origin(edge), s = line_.s - a;
    const W here = at_, s_along = s.dot(u), d_along = line_.d.dot(u);
    const Vec3<W> from = s - u * s_along, way = line_.d - u * d_along;
    const W across = way.squaredNorm();
    const auto leave = [&](const Mask<W>& now, double kind, const W& to) {
      go_to(which & now, kind, to);
      which &= !now;
    };
    leave(!(across > line_.parallel), feature::vertex, select(d_along > W(0), here, next(edge)));
    const Contact found = contact(from, way, across);
    leave(!found.is_clear, feature::none, here);
    const W at = s_along + d_along * found.t;
    leave(at < W(0), feature::vertex, here);
    leave(at > length(edge), feature::vertex, next(edge));
    // The edge supports if both adjacent triangles fall away from the edge's contact. If these two
    // are in one plane, the triangles beyond them must fall away, too.
    if (!any(which)) return;
    const W other = twin(edge);
    const W rise = found.out.dot(inwards(edge));
    const W other_rise = found.out.dot(inwards(numbers<8>(other)));
    const Mask<W> rises = which & (max(rise, other_rise) > W(0));
    if (any(rises)) go_over(rises, select(rise > other_rise, here, other));
    which &= !rises;
    leave(!(found.out.dot(widen<W>(of_.inner) - a) < W(0)), feature::vertex, here);
    const W to_end = min(at, W(length(edge) - at));
    settle(which, found, min(to_end, min(W(-rise), W(-other_rise))));
  }

  void look_at_vertex(Mask<W> which) {
    const Vec3<W> place = origin(numbers<4>(at_));
    const Contact found = contact(line_.s - place, line_.d, line_.dd);
    go_to(which & !found.is_clear, feature::none, at_);
    which &= found.is_clear;
    // Visits the edges from the vertex, triangle by triangle.
    constexpr int most_edges = 256;
    const W start = at_;
    W steepest(-std::numeric_limits<double>::infinity()), up = start, edge = start;
    Mask<W> turning = which;
    for (int i = 0; i < most_edges && any(turning); ++i) {
      const W rise = found.out.dot(vector(numbers<4>(edge, 8), 0));
      const Mask<W> steeper = turning & (rise > steepest);
      steepest = select(steeper, rise, steepest);
      up = select(steeper, edge, up);
      edge = lookup(edge, [&](std::size_t e) { return std::abs(of_.walk[e * of_.walk_row + 3]); });
      turning &= edge != start;
    }
    go_to(turning, feature::none, start);
    which &= !turning;
    const Mask<W> climbs =
        which & ((steepest > W(0)) | !(found.out.dot(widen<W>(of_.inner) - place) < W(0)));
    go_to(climbs, feature::edge, up);
    settle(which & !climbs, found, W(-steepest));
  }

  const PolytopeTables& of_;
  double r_;
  const Line<W>& line_;
  W feature_ = W(feature::none), at_ = W(0);
  Entry<W> entry_;
};

template <class W>
void find_lost(const PolytopeTables& of, const Line<W>& line, const Mask<W>& lost,
               Entry<W>& entry) {
  if constexpr (std::is_same_v<W, double>) {
    entry = enter_any_feature(of, line);
  } else {
    W hit = select(entry.hit, W(1), W(0)), miss = select(entry.miss, W(1), W(0));
    for (int i = 0; i < LaneOf<W>::count; ++i) {
      if (!lost.lane(i)) continue;
      const auto lane = [i](const Vec3<W>& v) -> Vec3<double> {
        return {v.x().lane(i), v.y().lane(i), v.z().lane(i)};
      };
      const Entry<double> found =
          enter_any_feature(of, {lane(line.s), lane(line.d), line.dd.lane(i), line.inv.lane(i),
                                 line.E.lane(i), line.parallel.lane(i)});
      hit.set_lane(i, found.hit ? 1 : 0);
      miss.set_lane(i, found.miss ? 1 : 0);
      entry.t.set_lane(i, found.t);
      entry.e.set_lane(i, found.e);
      for (int k = 0; k < 3; ++k) entry.normal[k].set_lane(i, found.normal[k]);
    }
    entry.hit = hit > W(0);
    entry.miss = miss > W(0);
  }
}

/// Finds where lines that meet the ball enter the polytope grown by a radius. Starts from a face
/// whose normal is likely to be near that of the entry. If this face does not face the line, starts
/// where the line passes the polytope without the radius.
template <class W>
Entry<W> enter_features(const PolytopeTables& of, const Line<W>& line, const Mask<W>& open) {
  WalkEnd<W> start;
  start.edge = first_edge(of, line);
  const PlaneRow<W> plane(of, plane_of(of, start.edge));
  start.in_triangle = open & (plane.normal.dot(line.d) < W(-least_component<W>));
  const Mask<W> away = open & !start.in_triangle;
  if (any(away)) {
    const WalkEnd<W> end = follow(of, line, away);
    start.in_triangle |= away & end.in_triangle;
    start.past_edge = away & end.past_edge;
    start.edge = select(away, end.edge, start.edge);
  }
  Mask<W> lost = open;
  Entry<W> entry = RoundedWalk<W>(of, line).from(start, lost);
  if (any(lost)) find_lost(of, line, lost, entry);
  return entry;
}

}  // namespace minkray::exact
