// SPDX-License-Identifier: MIT
// Where a line enters a polytope that is grown by a radius: the nearest face moved out, or the
// cylinder around an edge, or the ball around a vertex, whichever its contact says is supported by
// what is next to it. From piece to piece as Lin and Canny do ("A Fast Algorithm for Incremental
// Distance Calculation", 1991).
#include <algorithm>
#include <cmath>

#include "core/exact/polytope.h"
#include "core/query/tolerances.h"

namespace minkray::exact {

double Polytope::rounding(double rounded_by) const {
  if (!(rounded_by > 0)) return rounding_;
  // What is beside a piece rises by no more than rounding where it seems to fall, and what is
  // further away by so many times more.
  const double all = tolerance::polytope_rounding * (radius_ + rounded_by);
  return all + 2 * rounding_ / room_for_rounding_;
}

class Polytope::RoundedWalk {
 public:
  RoundedWalk(const Polytope& polytope, double radius, const Line<double>& line)
      : polytope_(polytope), r_(radius), line_(line) {}

  /// Goes from where the line passes the polytope itself, piece by piece, to the one that supports.
  Entry<double> from(const WalkEnd& end) {
    constexpr int most_pieces = 24;
    if (end.where != WalkEnd::lost) {
      go_to(end.where == WalkEnd::in_triangle ? Piece::face : Piece::edge, end.triangle, end.edge);
      for (int i = 0; i < most_pieces; ++i)
        if (look()) return entry_;
    }
    return of_any();
  }

 private:
  enum class Piece : unsigned char { none, face, edge, vertex };
  /// The line and a piece's cylinder or ball: where it enters, or is closest.
  struct Contact {
    bool meets = false, is_clear = false;
    double t = 0, e = 0;
    Vec3<double> out;  ///< from the axis or centre to the line there
  };

  /// Looks at the next piece; false, if it leads to another one.
  bool look() {
    const Piece piece = next_;
    next_ = Piece::none;
    if (piece == Piece::face) at_face();
    if (piece == Piece::edge) at_edge();
    if (piece == Piece::vertex) at_vertex();
    return next_ == Piece::none;
  }

  /// On flat and slender polytopes the way from piece to piece may lead round in circles: whichever
  /// supports is the one.
  Entry<double> of_any() {
    constexpr std::size_t most_triangles = 128;
    const std::size_t count = polytope_.triangles_.size();
    if (count > most_triangles) return {};
    for (std::size_t f = 0; f < count; ++f)
      for (const Piece piece : {Piece::face, Piece::edge, Piece::vertex})
        for (std::size_t k = 0; k < (piece == Piece::face ? 1 : 3); ++k) {
          entry_ = {};
          go_to(piece, f, k);
          if (look() && (entry_.hit || entry_.miss)) return entry_;
        }
    return {};
  }

  void go_to(Piece piece, std::size_t triangle, std::size_t k) {
    next_ = piece;
    triangle_ = static_cast<std::uint32_t>(triangle);
    k_ = static_cast<std::uint32_t>(k);
  }

  const Vec3<double>& corner(std::size_t triangle, std::size_t k) const {
    return polytope_.vertices_[polytope_.triangles_[triangle].corner[k % 3]];
  }

  /// Goes to a triangle from its edge k; if it faces away, to its other edge that is nearer.
  void go_over(std::size_t triangle, std::size_t k) {
    const std::size_t plane = polytope_.triangles_[triangle].plane;
    if (polytope_.planes_.normal(plane).dot(line_.d) < -least_component)
      return go_to(Piece::face, triangle, 0);
    const auto distance = [&](std::size_t edge) {
      const Vec3<double> along = corner(triangle, edge + 1) - corner(triangle, edge);
      const Vec3<double> across = along.cross(line_.d);
      return std::abs(across.dot(line_.s - corner(triangle, edge))) / across.norm();
    };
    go_to(Piece::edge, triangle, (k + (distance(k + 1) < distance(k + 2) ? 1 : 2)) % 3);
  }

  /// `from` and `way` lead to the line, both at right angles to the axis, whose square is `across`.
  Contact contact(const Vec3<double>& from, const Vec3<double>& way, double across) const {
    Contact found;
    const double inv = 1 / across, k = -from.dot(way) * inv;
    const Vec3<double> x = from + way * k;
    const double h2 = r_ * r_ - x.squaredNorm(), margin = 4 * r_ * line_.E;
    found.is_clear = std::abs(h2) > margin;
    found.meets = h2 > 0;
    if (!found.is_clear) return found;
    const double half = found.meets ? std::sqrt(h2 * inv) : 0;
    found.t = k - half;
    found.out = x - way * half;
    found.e = found.meets ? 2 * line_.E * r_ * inv / half : 0;
    return found;
  }

  /// Hit or miss, unless so near to where another piece begins that its formula might be the right
  /// one, and is further apart than E (docs/theory.md, section 13).
  void settle(const Contact& found, double nearest_end) {
    const double width = found.e * found.e * line_.dd;
    if (found.meets && width > r_ * line_.E && nearest_end * nearest_end < width) return;
    entry_.hit = found.meets;
    entry_.miss = !found.meets;
    entry_.t = found.t;
    entry_.e = found.e;
    entry_.normal = found.meets ? Vec3<double>(found.out * (1 / r_)) : found.out;
  }

  void at_face() {
    const std::size_t plane = polytope_.triangles_[triangle_].plane;
    const Vec3<double> n = polytope_.planes_.normal(plane);
    const double slope = n.dot(line_.d);
    if (!(slope < -least_component)) return;
    const double inv = -1 / slope;
    const double t = -(polytope_.planes_.offset(plane) + r_ - n.dot(line_.s)) * inv;
    const Vec3<double> foot = line_.s + line_.d * t - n * r_;
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t beyond = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<double>&a = corner(triangle_, k), &b = corner(triangle_, k + 1);
      const Vec3<double> along = b - a;
      const double within = n.cross(along).dot(foot - a) / along.norm();
      if (!(within < nearest)) continue;
      nearest = within;
      beyond = k;
    }
    if (nearest < 0) return go_to(Piece::edge, triangle_, beyond);
    const double e = (line_.E + polytope_.planes_.depth(plane)) * inv;
    settle({true, true, t, e, Vec3<double>(n * r_)}, nearest);
    entry_.normal = n;
  }

  void at_edge() {
    const Vec3<double>&a = corner(triangle_, k_), &b = corner(triangle_, k_ + 1);
    const Vec3<double> along = b - a;
    const double length2 = along.squaredNorm(), per = 1 / length2;
    const Vec3<double> s = line_.s - a;
    const double s_along = s.dot(along) * per, d_along = line_.d.dot(along) * per;
    const Vec3<double> from = s - along * s_along, way = line_.d - along * d_along;
    const double across = way.squaredNorm();
    if (!(across > line_.parallel))
      return go_to(Piece::vertex, triangle_, d_along > 0 ? k_ : (k_ + 1) % 3);
    const Contact found = contact(from, way, across);
    if (!found.is_clear) return;
    const double at = s_along + d_along * found.t;
    if (at < 0) return go_to(Piece::vertex, triangle_, k_);
    if (at > 1) return go_to(Piece::vertex, triangle_, (k_ + 1) % 3);
    // The edge supports, if both triangles beside it fall away, and, lest they are in one plane,
    // what is behind them.
    if (!(found.out.dot(polytope_.inner_ - a) < 0)) return go_to(Piece::vertex, triangle_, k_);
    const std::uint32_t beyond = polytope_.triangles_[triangle_].beyond[k_];
    const auto rise = [&](const Vec3<double>& opposite) {
      const Vec3<double> beside = opposite - a;
      const Vec3<double> up = beside - along * (beside.dot(along) * per);
      return found.out.dot(up) / up.norm();
    };
    const double here = rise(corner(triangle_, k_ + 2));
    const double there = rise(corner(beyond / 4, beyond % 4 + 2));
    if (std::max(here, there) > 0)
      return here > there ? go_over(triangle_, k_) : go_over(beyond / 4, beyond % 4);
    const double length = std::sqrt(length2);
    settle(found, std::min({at * length, (1 - at) * length, -here, -there}));
  }

  void at_vertex() {
    const Vec3<double>& vertex = corner(triangle_, k_);
    const Contact found = contact(line_.s - vertex, line_.d, line_.dd);
    if (!found.is_clear) return;
    // The edges from it, triangle by triangle.
    constexpr int most_edges = 256;
    double steepest = -std::numeric_limits<double>::infinity();
    std::size_t triangle = triangle_, k = k_, up = triangle_, up_k = k_;
    for (int i = 0; i < most_edges; ++i) {
      const Vec3<double> along = corner(triangle, k + 1) - vertex;
      const double rise = found.out.dot(along) / along.norm();
      if (rise > steepest) {
        steepest = rise;
        up = triangle;
        up_k = k;
      }
      const std::uint32_t before = polytope_.triangles_[triangle].beyond[(k + 2) % 3];
      triangle = before / 4;
      k = before % 4;
      if (triangle != triangle_) continue;
      if (steepest > 0 || !(found.out.dot(polytope_.inner_ - vertex) < 0))
        return go_to(Piece::edge, up, up_k);
      return settle(found, -steepest);
    }
  }

  const Polytope& polytope_;
  double r_;
  const Line<double>& line_;
  Piece next_ = Piece::none;
  std::uint32_t triangle_ = 0, k_ = 0;
  Entry<double> entry_;
};

Entry<double> Polytope::enter_rounded(double radius, const Line<double>& line) const {
  return RoundedWalk(*this, radius, line).from(follow(line));
}

}  // namespace minkray::exact
